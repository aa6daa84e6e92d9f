# SPDX-License-Identifier: GPL-2.0-only
"""Examples at any size: tanks with a free surface, rotating patch, pipe, without measurements.

The script of an example up to its measurements, and the variable that sets the number of particles.
"""

import sys
from dataclasses import dataclass, field

import scene


@dataclass(frozen=True)
class Scene:
    case: str
    dimension: int
    example: str
    end: str                # the comment that ends the part to keep
    option: str             # the variable of the size
    sizes: dict             # {nominal number of particles, walls included: value of the variable}
    fixed: dict = field(default_factory=dict)

    def variables(self, nominal):
        here = scene.EXAMPLES / self.example
        return {self.option: self.sizes[nominal], "here": here, "python": sys.executable,
                **self.fixed}

    def upto(self, largest):
        """Nominal sizes, also the one that is as large as asked for."""
        return [nominal for nominal in self.sizes if nominal <= 1.001 * largest]

    def head(self):
        return until(scene.script(self.example), self.end)


def until(text, comment):
    """The part of a script before the line '# --- comment ...'."""
    mark = f"\n# --- {comment}"
    if text.count(mark) != 1:
        raise ValueError(f"the script has no single line '{mark.strip()}'")
    return text[:text.index(mark) + 1]


TANK_2D = Scene("2d-tank", 2, "tank", "measurements", "n",
                {1e3: 42, 3e3: 76, 1e4: 140, 3e4: 244, 1e5: 446, 3e5: 774, 1e6: 1414},
                {"dim": 2, "jitter": 0.2})
TANK_3D = Scene("3d-tank", 3, "tank", "measurements", "n",
                {1e3: 10, 3e3: 16, 1e4: 26, 2e4: 34, 1e5: 58, 2e5: 72, 1e6: 128},
                {"dim": 3, "jitter": 0.2})
# moves with the fluid, unshifted; the jitter makes the lattice irregular from the first step
PATCH = Scene("2d-patch", 2, "square-patch", "measurements", "d",
              {1e3: 1 / 32, 3e3: 1 / 55, 1e4: 1 / 100, 3e4: 1 / 173, 1e5: 1 / 316, 3e5: 1 / 548,
               1e6: 1 / 1000}, {"shift": "none", "jitter": 0.1})
# radius of 4, 8, 12, 19, 28 and 42 spacings
PIPE = Scene("pipe", 3, "poiseuille", "errors", "d",
             {1e3: 1.25e-4, 1e4: 6.25e-5, 3e4: 5e-4 / 12, 1e5: 5e-4 / 19, 3e5: 5e-4 / 28,
              1e6: 5e-4 / 42})
