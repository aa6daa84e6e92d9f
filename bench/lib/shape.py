# SPDX-License-Identifier: GPL-2.0-only
"""Area and edge of the region that particles in two dimensions fill, from their positions.

The region is where the kernel sum V sum_j W exceeds 1/2, counted on a grid. One particle alone
does not reach 1/2 (a cubic spline with h = 1.2 d has 0.32 at its centre): drops of a few particles
are spray, of the volume V each, and are in no edge.
"""

from dataclasses import dataclass

import numpy as np

H_OVER_D = 1.2  # kernel of the measurement: cubic spline, whatever the run uses
CELLS = 4       # grid cells in a spacing
CORNERS = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], dtype=float)  # of a cell


@dataclass
class Shape:
    area: float     # of the fluid in the region, and V for each particle of the spray
    edge: float     # length of its edge, without where it lies on a wall
    spray: np.ndarray  # mask of the particles outside of the region


def kernel(q):
    """Cubic spline in 2d times h^2."""
    inner = 1.0 - 1.5 * q**2 + 0.75 * q**3
    return 10.0 / (7.0 * np.pi) * np.where(q < 1.0, inner, 0.25 * np.maximum(2.0 - q, 0.0)**3)


def kernel_sum(points, low, shape, d):
    """V sum_j W at low + (column, row) d/CELLS."""
    g = d / CELLS
    reach = int(np.ceil(2.0 * H_OVER_D * CELLS))
    offsets = np.arange(-reach, reach + 1)
    total = np.zeros(np.add(shape, 2 * reach))  # with a margin for points near the border
    for point in (np.asarray(points) - low) / g:
        nearest = np.rint(point).astype(int)
        if np.any(nearest < 0) or np.any(nearest >= shape):
            continue
        dx, dy = (offsets + nearest[k] - point[k] for k in range(2))
        q = np.hypot(dx[:, None], dy[None, :]) / (H_OVER_D * CELLS)
        column, row = nearest
        total[column:column + 2 * reach + 1, row:row + 2 * reach + 1] += kernel(q) / H_OVER_D**2
    return total[reach:-reach, reach:-reach]


def pieces(values):
    """Of a cell with these values at its corners: the polygon where they are positive, the cuts."""
    polygon, cuts = [], []
    for k in range(4):
        a, b = values[k], values[(k + 1) % 4]
        if a > 0:
            polygon.append(CORNERS[k])
        if (a > 0) != (b > 0):
            cuts.append(CORNERS[k] + (CORNERS[(k + 1) % 4] - CORNERS[k]) * a / (a - b))
            polygon.append(cuts[-1])
    return np.array(polygon), cuts


def area_and_edge(total):
    """Area where total > 1/2, and the length of its edge: linear interpolation in every cell."""
    values = np.stack([total[:-1, :-1], total[1:, :-1], total[1:, 1:], total[:-1, 1:]]) - 0.5
    crossed = (values.max(axis=0) > 0) & (values.min(axis=0) <= 0)
    area, edge = float((values.min(axis=0) > 0).sum()), 0.0
    for cell in values[:, crossed].T:
        polygon, cuts = pieces(cell)
        (x, y), (u, v) = polygon.T, np.roll(polygon, -1, axis=0).T
        area += 0.5 * np.sum(x * v - u * y)
        edge += sum(np.hypot(*(p - q)) for p, q in zip(cuts[::2], cuts[1::2]))
    return area, edge


def wet(walls, fluid, d):
    """Wall particles that have fluid within 1.7 d, that is also in concave corners."""
    if not len(fluid) or not len(walls):
        return walls[:0]
    distance2 = ((walls[:, None, :] - fluid[None, :, :])**2).sum(axis=2)
    return walls[distance2.min(axis=1) < (1.7 * d)**2]


def measure(fluid, walls, d, inside=None):
    """Shape of the fluid; inside: ((x0, x1), (y0, y1)) where it may be, that is between walls.

    Walls are particles on these lines; those next to fluid stand for fluid beyond them.
    """
    fluid, walls = np.reshape(fluid, (-1, 2)), np.reshape(walls, (-1, 2))
    g = d / CELLS
    if inside is None:
        inside = [(fluid[:, k].min() - 3 * d, fluid[:, k].max() + 3 * d) for k in range(2)]
    low = np.array([side[0] for side in inside])
    # Cells have their corners on the border: their number is the area.
    shape = [int(round((side[1] - side[0]) / g)) + 1 for side in inside]
    total = kernel_sum(np.vstack([fluid, wet(walls, fluid, d)]), low, shape, d)
    cells = np.rint((fluid - low) / g).astype(int)
    here = np.all((cells >= 0) & (cells < shape), axis=1)
    spray = np.ones(len(fluid), dtype=bool)
    spray[here] = total[cells[here, 0], cells[here, 1]] <= 0.5
    area, edge = area_and_edge(total)
    # Particles keep a spacing away from walls, whose particles have the half of it that is next to
    # them: it does not belong to the volume of the fluid.
    wetted = sum((line > 0.5).sum() for line in (total[0], total[-1], total[:, 0])) * g
    volume = area * g * g - 0.5 * d * wetted + spray.sum() * d * d
    return Shape(volume, edge * g, spray)
