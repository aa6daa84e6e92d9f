#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Plane channel: this package next to LAMMPS' own RHEO and SPH, error against run time.

Every run is one process on one core, one after the other on the same machine. Writes peers.csv,
peers-ratios.csv, peers-summary.csv and peers.md, and prints ALEISPH-RESULT lines with the ratios.
"""

import argparse
import statistics
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "lib"))

import channel  # noqa: E402  (found in bench/lib)
import common  # noqa: E402

DEFAULT_OUT = Path(__file__).resolve().parent / "results"
TARGET = 100  # at least so much less run time at equal error, or less error at equal run time
REPEATS, SHORT = 5, 1.0  # runs below so many seconds are repeated; the median counts
# Our settings that are compared with the peers. The series "example" (forward Euler) is not among
# them: its error in time cancels a part of its error in space.
FAMILIES = ("ab2", "tuned", "lagrangian", "lagrangian tuned")
COLUMNS = {"code": "code", "variant": "settings", "n": "2H/d", "N": "N", "tol": "tol",
           "dt nu/H^2": "nu dt/H^2", "steps": "steps", "time": "nu t/H^2", "seconds": "seconds",
           "l2": "L2", "l2 nominal wall": "L2, nominal wall", "wall shift/d": "wall shift/d"}


def peer_setups(long):
    """'example': settings of LAMMPS' examples. 'tuned': what was found to serve each peer best."""
    for n in (15, 30, 60) if long else (15, 30):
        yield channel.rheo("example", n, channel.MACH, 1, zeta=1, jitter=0.1)
    for n in (15, 30, 60):
        yield channel.sph("example", n, channel.MACH, 1)
    # u_max/cs = 0.1 is usual for weakly compressible SPH; the time step is near the largest stable
    # one (SPH fails at a factor of 6).
    for n in (15, 30, 60):
        yield channel.rheo("tuned", n, 0.1, 4, zeta=0, jitter=0)
    for n in (15, 30, 60):
        yield channel.sph("tuned", n, 0.1, 3)


def own_setups():
    # Settings of examples/poiseuille-plane
    for n in (15, 30):
        yield channel.aleisph("example", n, 0.1, 1e-10)
    # Explicit and of second order in time; 0.173 is the largest step without a warning.
    for n in (15, 30, 60):
        for step in (1, 0.5):
            yield channel.aleisph("ab2", n, 0.16, 1e-8, step=step, integrator="ab2")
    for n in (8, 15, 30):
        yield channel.aleisph("lagrangian", n, 0.16, 1e-8, frame="lagrangian", integrator="ab2")
    # Crank-Nicolson with steps proportional to d: at half of them the errors hardly change.
    for n in (8, 15, 30, 60):
        for step in (1, 0.5):
            for tol in (1e-6, 1e-9):
                yield tuned("tuned", n, tol, step=step)
        yield tuned("lagrangian tuned", n, 1e-6, frame="lagrangian")
    # Beyond three resolutions, so that less of the comparison is only a bound
    yield tuned("tuned", 5, 1e-9)
    yield tuned("tuned", 120, 1e-9)


def tuned(variant, n, tol, **options):
    """nu dt/H^2 = 4/(15 n), but no less than 6 steps until the first comparison."""
    return channel.aleisph(variant, n, min(n / 15, n**2 / 240), tol, scheme="cn", **options)


def measure(setup, scratch):
    """Rows of one setup. A short run is repeated, and the medians of its wall-clock times count:
    LAMMPS' share of the core is not meaningful over milliseconds."""
    rows = channel.run(setup, scratch)
    if rows[-1]["seconds"] < SHORT:
        all_rows = [rows] + [channel.run(setup, scratch) for _ in range(REPEATS - 1)]
        for index, row in enumerate(rows):
            row["seconds"] = statistics.median(again[index]["wall"] for again in all_rows)
    return rows


def run_all(setups, scratch):
    table = []
    for index, setup in enumerate(setups):
        rows = measure(setup, scratch / str(index))
        table += rows
        errors = " ".join(f"{row['l2']:.2e}" for row in rows)
        print(f"  {setup.code:8s} {setup.variant:16s} n={setup.n:<3d} "
              f"{rows[-1]['seconds']:8.2f} s  L2 = {errors}", flush=True)
    return table


def ratios(table):
    """Every peer run at every time against each family of our runs at the same time."""
    out = []
    for row in table:
        for family in FAMILIES if row["code"] != "aleisph" else ():
            ours = [(r["seconds"], r["l2"]) for r in table if r["code"] == "aleisph"
                    and r["variant"] == family and r["time"] == row["time"]]
            if ours:
                nominal = compare(row["seconds"], row["l2 nominal wall"], ours)
                out.append({"ours": family, "peer": f"{row['code']} {row['variant']}",
                            **{key: row[key] for key in ("n", "time", "seconds", "l2")},
                            **compare(row["seconds"], row["l2"], ours),
                            "l2 nominal wall": row["l2 nominal wall"],
                            "time ratio nominal wall": nominal["time shown"],
                            "error ratio nominal wall": nominal["error shown"]})
    return out


def compare(its_seconds, its_error, ours):
    seconds, quicker = common.time_for_error(ours, its_error)
    error, better = common.error_at_time(ours, its_seconds)
    time_ratio = its_seconds / seconds if seconds else None
    error_ratio = its_error / error if error else None
    return {"time ratio": time_ratio, "time shown": shown(time_ratio, quicker),
            "error ratio": error_ratio, "error shown": shown(error_ratio, better)}


def shown(ratio, relation):
    """Ours is a bound ("<"): the ratio is at least this. None: we have no run to compare with."""
    if ratio is None:
        return "-"
    return (">" if relation == "<" else "") + f"{float(f'{ratio:.2g}'):g}"


def least(compared, peer, time, family):
    """The run of this peer at this time where our family is least ahead."""
    rows = [r for r in compared
            if r["peer"] == peer and r["time"] == time and r["ours"] == family]
    return min(rows, key=lambda r: max(r["time ratio"] or 0, r["error ratio"] or 0))


def summary(compared):
    """One row per peer and time: for each of our families the ratios where it is least ahead."""
    for peer in dict.fromkeys(row["peer"] for row in compared):
        for time in channel.TIMES:
            cells = {"peer": peer, "nu t/H^2": time}
            for family in FAMILIES:
                row = least(compared, peer, time, family)
                cells[family] = f"{row['time shown']} / {row['error shown']} (n={row['n']})"
            yield cells


def verdicts(compared):
    for peer in dict.fromkeys(row["peer"] for row in compared):
        for time in channel.TIMES:
            for family in FAMILIES:
                row = least(compared, peer, time, family)
                for key, quantity in (("time ratio", "time-ratio"), ("error ratio", "error-ratio")):
                    value = row[key] if row[key] is not None else "none"
                    yield common.result_line(
                        case=f"{peer}/{family}".replace(" ", "-"), quantity=quantity, time=time,
                        value=value, reference=TARGET, l2=row["l2"], seconds=row["seconds"])


def run_channel(long, only_peers):
    """Runs the channel with every code; returns the rows of the runs and those of the ratios."""
    print("Plane channel, one core per run", flush=True)
    setups = ([] if only_peers else list(own_setups())) + list(peer_setups(long))
    with tempfile.TemporaryDirectory(prefix="aleisph-bench-") as scratch:
        table = run_all(setups, Path(scratch))
    return table, ratios(table)


def write_report(table, compared, out):
    """Writes the tables of the channel; returns them as Markdown."""
    common.write_csv(out / "peers.csv", table)
    text = common.markdown(table, COLUMNS)
    if compared:
        common.write_csv(out / "peers-ratios.csv", compared)
        least_ahead = list(summary(compared))
        common.write_csv(out / "peers-summary.csv", least_ahead)
        text = ("Its run time over ours at equal L2 / its L2 over ours at equal run time, at the "
                "run (n) of the\npeer where we are least ahead:\n\n"
                + common.markdown(least_ahead, {key: key for key in least_ahead[0]})
                + "\nAll runs:\n\n" + text)
    (out / "peers.md").write_text(text, encoding="ascii")
    return text


def arguments(description):
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--out", type=Path, default=DEFAULT_OUT, help="folder of what is written")
    parser.add_argument("--long", action="store_true",
                        help="RHEO's example at n = 60, too (10 min more)")
    return parser


def main():
    parser = arguments(__doc__)
    parser.add_argument("--only-peers", action="store_true", help="run RHEO and SPH only")
    options = parser.parse_args()
    table, compared = run_channel(options.long, options.only_peers)
    print(write_report(table, compared, options.out))
    for line in verdicts(compared):
        print(line)


if __name__ == "__main__":
    main()
