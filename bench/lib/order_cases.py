# SPDX-License-Identifier: GPL-2.0-only
"""The series of bench/order.py: flows with an exact or a reference solution, in every frame.

Integrator ab2 wherever viscosity, convection or the motion relative to the fluid is explicit: forward
Euler, the default, is of first order. What is wanted is 2 for velocities and in time, 1.5 for the
pressure, which is a derivative of them.
"""

from orders import Series

SECOND = {"u": 2, "p": 1.5}
FRAMES = ("eulerian", "lagrangian", "ale")
MOVING = {"ale": "density", "lagrangian": "none"}    # the variable shift of the examples
AB2 = (("move", "integrator ab2"),)


def halved(name, first, count=4, **variables):
    """Runs with a variable that is halved again and again."""
    return [(first / 2**k, {name: first / 2**k, **variables}) for k in range(count)]


def sized(name, sizes, **variables):
    return [(n, {name: n, **variables}) for n in sizes]


def vortices(full):
    """t U/L = 1 in space; 0.25 in time, before the flow has torn the lattice apart. Without shifting
    that is so from 0.1 on: 0.05."""
    errors = {"u": "l2", "p": "l2"}
    for frame in FRAMES:
        long, short = (1, 1) if frame == "lagrangian" else (20, 5)    # in units of 0.05 L/U
        yield Series("taylor-green", frame, f"t={0.05 * long:g}", "space",
                     sized("N", (16, 32, 64, 128) if full else (16, 32, 64), vn=0.05, marks=long,
                           every=20, frame=frame), errors, wanted=SECOND)
        yield Series("taylor-green", frame, f"t={0.05 * short:g}", "time",
                     halved("vn", 0.1, marks=short, every=20, tol=1e-10, frame=frame), errors, 32,
                     ("u", "p"), {"u": 2})


def stokes_box(full):
    errors = {"u": "l2", "p": "l2"}
    for what, first, changes in (("ab2", 0.1, AB2), ("cn", 0.4, (("move", "scheme cn"),))):
        yield Series("stokes-box", "eulerian", what, "space",
                     sized("n", (10, 20, 40, 80) if full else (10, 20, 40), vn=first, marks=20,
                           every=20), errors, wanted={"u": 2, "p": 1.8}, changes=changes)
        yield Series("stokes-box", "eulerian", what, "time",
                     halved("vn", first, n=20, marks=20, every=20, tol=1e-10), errors, 20,
                     ("u", "p"), {"u": 2}, changes)


def cavity(full):
    """The steady flow below a smooth lid; its first two units of time, for the order in time."""
    errors = {"u": "l2", "p": "l2"}
    given = {"lid": "smooth", "Re": 100}
    for frame in ("eulerian", "ale"):
        sizes = (20, 40, 80) if full and frame == "eulerian" else (20, 40)
        yield Series("cavity", frame, "steady", "space",
                     sized("n", sizes, frame=frame, T=20, every=20, **given), errors, wanted=SECOND)
        yield Series("cavity", frame, "start-up", "time",
                     halved("cfl", 0.2, n=20, frame=frame, T=2, every=2, tol=1e-10, **given), {}, 20,
                     ("u", "p"), {"u": 2})
    yield Series("cavity", "eulerian", "steady", "time",
                 halved("cfl", 0.2, n=20, T=20, every=20, tol=1e-10, **given), errors, 20,
                 ("u", "p"))


def cylinders(full):
    """Steady drag with implicit steps of 1 to 40 d^2/nu; the start, for the order in time."""
    errors = {"K": "relative"}
    yield Series("cylinder-array", "eulerian", "steady", "space",
                 sized("n", (10, 20, 40, 80) if full else (10, 20, 40), scheme="be", vn=1), errors,
                 wanted={"K": 2})
    yield Series("cylinder-array", "eulerian", "be, steady", "time",
                 halved("vn", 40.0, 6, n=40, scheme="be", T=0.6, tol=1e-10), errors, 40)
    yield Series("cylinder-array", "eulerian", "cn, start-up", "time",
                 halved("vn", 1.6, n=20, scheme="cn", T=0.02, tol=1e-10), {}, 20, ("u", "p"),
                 {"u": 2})


def wave(full):
    """Not without shifting: such runs blow up."""
    for frame, shift in (("ale", "density"),):
        for nu, other in ((0, "amplitude"), (0.002, "decay")):
            errors = {"frequency": "relative", other: "relative"}
            what = "viscous" if nu else "inviscid"
            given = {"nu": nu, "shift": shift}
            yield Series("wave", frame, what, "space",
                         sized("n", (16, 32, 64) if full else (16, 32), cdt=0.1, **given), errors,
                         wanted={"frequency": 2}, changes=AB2)
            yield Series("wave", frame, what, "time",
                         halved("cdt", 0.4, n=16, periods=4, tol=1e-10, **given), errors, 16,
                         wanted={"u": 2}, changes=AB2)


def patch(full):
    errors = {"p-deviation": "linf", "energy": "relative"}
    for frame, shift in MOVING.items():
        runs = [(n, {"d": 1 / n, "cfl": 0.1, "T": 2, "shift": shift})
                for n in ((25, 50, 100) if full else (25, 50))]
        yield Series("square-patch", frame, "", "space", runs, errors,
                     wanted={"p-deviation": 1.5}, changes=AB2)
        yield Series("square-patch", frame, "t=1", "time",
                     halved("cfl", 0.2, d=0.04, T=1, shift=shift, tol=1e-10), errors, 25, ("u", "p"),
                     {"u": 2}, AB2)


CASES = {"taylor-green": vortices, "stokes-box": stokes_box, "cavity": cavity,
         "cylinder-array": cylinders, "wave": wave, "square-patch": patch}


def all_series(names, full):
    for name in names or CASES:
        yield from CASES[name](full)
