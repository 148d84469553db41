"""Grids of a run as coloured pixels, for tools/pictures: land by its height and shade, water over it."""
import math
import pathlib

BLANK = -9999.0
LAND = [(0.0, (172, 152, 112)), (0.5, (205, 188, 150)), (1.0, (226, 216, 190))]


class Grid:
    """Values on a lattice; row 0 is the lowest. x, y: place of the first value [m]."""

    def __init__(self, x, y, cell, rows):
        self.x, self.y, self.cell, self.rows = x, y, cell, rows

    def like(self, rows):
        return Grid(self.x, self.y, self.cell, rows)


def read_grid(path, nodes=False):
    lines = pathlib.Path(path).read_text().split("\n")
    head = {line.split()[0].lower(): float(line.split()[1]) for line in lines[:6]}
    rows = [[float(v) for v in line.split()] for line in lines[6:] if line.strip()]
    half = 0 if nodes else head["cellsize"] / 2
    return Grid(head["xllcorner"] + half, head["yllcorner"] + half, head["cellsize"], rows[::-1])


def combined(function, *grids):
    every = zip(*(g.rows for g in grids))
    return grids[0].like([[function(*values) for values in zip(*rows)] for rows in every])


def near_mean(rows, i, j):
    near = [v for row in rows[max(0, j - 1):j + 2] for v in row[max(0, i - 1):i + 2] if v != BLANK]
    return sum(near) / len(near) if near else BLANK


def filled(grid, times=6):
    """Blank cells next to others get the mean of those: what a smooth edge is drawn from. The rest: 0."""
    rows = grid.rows
    for _ in range(times):
        rows = [[near_mean(rows, i, j) if v == BLANK else v for i, v in enumerate(row)]
                for j, row in enumerate(rows)]
    return grid.like([[0.0 if v == BLANK else v for v in row] for row in rows])


def mixed_with_neighbours(values):
    """1/4, 1/2, 1/4 along a list of numbers."""
    return [(a + 2 * m + b) / 4 for a, m, b in zip(values[:1] + values, values, values[1:] + values[-1:])]


def smoothed(grid):
    rows = [mixed_with_neighbours(row) for row in grid.rows]
    columns = [mixed_with_neighbours(list(column)) for column in zip(*rows)]
    return grid.like([list(row) for row in zip(*columns)])


def hillshade(grid, steep):
    """0 to 1, light from the upper left, 40 degrees high; heights times `steep`."""
    east, north, up = -0.54, 0.54, 0.64
    half = steep / (2 * grid.cell)

    def shade(left, right, below, above):
        sx, sy = half * (right - left), half * (above - below)
        return max(0.0, (up - sx * east - sy * north) / math.sqrt(1 + sx * sx + sy * sy))

    rows, out = grid.rows, []
    for low, row, high in zip(rows[:1] + rows, rows, rows[1:] + rows[-1:]):
        out.append([shade(*around) for around in zip(row[:1] + row, row[1:] + row[-1:], low, high)])
    return grid.like(out)


def resampled(grid, xs, ys):
    """Bilinear, as rows of pixels from the lowest up."""
    def places(at, first, count):
        found = []
        for v in at:
            s = min(max((v - first) / grid.cell, 0.0), count - 1.000001)
            found.append((int(s), s - int(s)))
        return found

    columns = places(xs, grid.x, len(grid.rows[0]))
    for j, b in places(ys, grid.y, len(grid.rows)):
        mixed = [p + (q - p) * b for p, q in zip(grid.rows[j], grid.rows[j + 1])]
        yield [mixed[i] + (mixed[i + 1] - mixed[i]) * a for i, a in columns]


def share(value, limits):
    return min(max((value - limits[0]) / (limits[1] - limits[0]), 0.0), 1.0)


def colour_at(palette, s):
    n = next(n for n in range(1, len(palette)) if s <= palette[n][0])
    (s0, a), (s1, b) = palette[n - 1], palette[n]
    return tuple(p + (q - p) * (s - s0) / (s1 - s0) for p, q in zip(a, b))


def colours(palette):
    """The palette as a table of 1024."""
    return [colour_at(palette, k / 1023) for k in range(1024)]


class Map:
    """Land by its height and shade, water by its value and gloss, the shore where `wet` is a half."""

    def __init__(self, bed, heights, shade, palette, limits):
        self.bed, self.heights, self.shade, self.limits = bed, heights, shade, limits
        self.land, self.water = colours(LAND), colours(palette)

    def pixel(self, level, shade, cover, value, gloss):
        lit = 0.40 + 0.88 * shade
        colour = [c * lit for c in self.land[int(1023 * share(level, self.heights))]]
        edge = share(cover, (0.42, 0.58))
        if edge > 0:
            lit = 0.52 + 0.75 * gloss
            water = self.water[int(1023 * share(value, self.limits))]
            colour = [c + (w * lit - c) * edge for c, w in zip(colour, water)]
        return (min(255, int(c)) for c in colour)

    def paint(self, path, box, width, wet, value, gloss):
        """Raw RGB at the path; what gnuplot plots of it."""
        x0, y0, x1, y1 = box
        cell, height = (x1 - x0) / width, round(width * (y1 - y0) / (x1 - x0))
        xs = [x0 + (i + 0.5) * cell for i in range(width)]
        ys = [y0 + (j + 0.5) * (y1 - y0) / height for j in range(height)]
        data = bytearray()
        grids = (self.bed, self.shade, wet, value, gloss)
        for rows in zip(*(resampled(grid, xs, ys) for grid in grids)):
            for values in zip(*rows):
                data.extend(self.pixel(*values))
        pathlib.Path(path).write_bytes(data)
        return (f'"{path}" binary array=({width},{height}) dx={cell} dy={(y1 - y0) / height} '
                f'origin=({xs[0]},{ys[0]}) format="%uchar" using 1:2:3 with rgbimage notitle')
