"""A small writer of IGES 5.3 files, enough for the surfaces of the side panel.

Entities are added one by one; `add` returns the number of the directory entry, by which
later entities point to earlier ones. Reals are written with all their digits.
"""


def real(value):
    """A number as IGES writes reals: with a decimal point, shortest form that reads back."""
    text = repr(float(value))
    if "e" in text:
        mantissa, exponent = text.split("e")
        return (mantissa if "." in mantissa else mantissa + ".") + "E" + exponent
    return text


def text(value):
    """A Hollerith string."""
    return "%dH%s" % (len(value), value)


def _field(value):
    if isinstance(value, float):
        return real(value)
    if isinstance(value, str):
        return text(value)
    return str(value)


class IgesFile:
    """Millimetres, version 5.3. The date is fixed, so that redrawing gives the same bytes."""

    DATE = "20261121.050000"

    def __init__(self, name):
        self.name = name
        self.directory = []
        self.parameters = []

    def add(self, kind, values, form=0, subordinate=0, label="", name=None, transform=0):
        """Adds an entity of that type number; `values` are its parameters in order.

        `subordinate` 1: another entity owns it. `name` of any length is attached as a name
        property (type 406, form 15); `label` has eight characters at most.
        """
        trailer = []
        if name:
            trailer = [0, 1, self.add(406, [1, name], form=15, subordinate=1)]
        number = 2 * len(self.directory) + 1
        lines = self._wrap([kind] + list(values) + trailer)
        status = "00%02d%02d00" % (subordinate, 0 if kind != 406 else 2)
        self.directory.append((kind, len(self.parameters) + 1, transform, status, len(lines),
                               form, label))
        self.parameters += [(line, number) for line in lines]
        return number

    @staticmethod
    def _wrap(values, width=64, last=";"):
        fields = [_field(value) for value in values]
        fields = [field + "," for field in fields[:-1]] + [fields[-1] + last]
        lines = [""]
        for field in fields:
            if len(lines[-1]) + len(field) > width and lines[-1]:
                lines.append("")
            lines[-1] += field
        return lines

    def _global(self):
        values = [",", ";", self.name, self.name + ".igs", "NURBSTrim", "DrawSidePanel", 32, 308,
                  15, 308, 15, self.name, 1.0, 2, "MM", 1, 0.1, self.DATE, 1e-6, 2000.0,
                  "NURBSTrim", "NURBSTrim", 11, 0, self.DATE]
        return self._wrap(values, width=72)

    def write(self, path):
        start = ["Side panel after Fig. 9 of Baptista et al. 2006: " + self.name]
        lines = ["%-72sS%7d" % (line, i + 1) for i, line in enumerate(start)]
        header = self._global()
        lines += ["%-72sG%7d" % (line, i + 1) for i, line in enumerate(header)]
        for i, (kind, first, transform, status, count, form, label) in enumerate(self.directory):
            lines.append("%8d%8d%8d%8d%8d%8d%8d%8d%8sD%7d" % (
                kind, first, 0, 0, 0, 0, transform, 0, status, 2 * i + 1))
            lines.append("%8d%8d%8d%8d%8d%8s%8s%8s%8dD%7d" % (
                kind, 0, 0, count, form, "", "", label[:8], 0, 2 * i + 2))
        for i, (line, owner) in enumerate(self.parameters):
            lines.append("%-64s %7dP%7d" % (line, owner, i + 1))
        lines.append("%-72sT%7d" % ("S%7dG%7dD%7dP%7d" % (
            len(start), len(header), 2 * len(self.directory), len(self.parameters)), 1))
        with open(path, "w", newline="\n") as stream:
            stream.write("\n".join(lines) + "\n")


def bspline_curve(points, weights, knots, degree):
    """Parameters of a planar or spatial curve, type 126."""
    polynomial = all(weight == weights[0] for weight in weights)
    return ([len(points) - 1, degree, 0, 0, int(polynomial), 0]
            + [float(knot) for knot in knots] + [float(weight) for weight in weights]
            + [float(value) for point in points for value in point]
            + [float(knots[degree]), float(knots[len(points)]), 0.0, 0.0, 0.0])


def bspline_surface(rows, weights, knots_u, knots_v, degree_u, degree_v):
    """Parameters of a surface, type 128. `rows` run along v, the points of a row along u."""
    count_u, count_v = len(rows[0]), len(rows)
    flat = [weight for row in weights for weight in row]
    polynomial = all(weight == flat[0] for weight in flat)
    closed = rows[0][0] == rows[0][-1]
    return ([count_u - 1, count_v - 1, degree_u, degree_v, int(closed), 0, int(polynomial), 0, 0]
            + [float(knot) for knot in knots_u] + [float(knot) for knot in knots_v]
            + [float(weight) for weight in flat]
            + [float(value) for row in rows for point in row for value in point]
            + [float(knots_u[degree_u]), float(knots_u[count_u]),
               float(knots_v[degree_v]), float(knots_v[count_v])])
