"""The summary that every trim leaves in its field data, as a table."""
import math

# Column title, array in the field data, format.
COLUMNS = [
    ("kept", "Kept", "%d"),
    ("eliminated", "Eliminated", "%d"),
    ("treated", "Treated", "%d"),
    ("moved nodes", "MovedNodes", "%d"),
    ("pentahedra", "Pentahedra", "%d"),
    ("wedges", "Wedges", "%d"),
    ("touched", "TouchedElements", "%d"),
    ("certified", "CertifiedElements", "%d"),
    ("min scaled J", "MinimumScaledJacobian", "%.3f"),
    ("min J at int. points", "MinimumIntegrationPointJacobian", "%.3f"),
    ("max distance", "MaximumDistanceToSurface", "%.1e"),
    ("volume", "Volume", "%.6g"),
    ("bandwidth", "NodeBandwidth", "%d"),
]


def values(trim):
    """The summary of one trim as a dictionary: array name to number."""
    trim.UpdatePipeline()
    ranges = {name: trim.FieldData[name].GetRange(0) for name in trim.FieldData.keys()}
    # Upside down, that of NaN: no element was touched that could be measured.
    return {name: low if low <= high else math.nan for name, (low, high) in ranges.items()}


def formatted(value, form):
    """No sign before a number that is rounded to zero."""
    text = form % value
    return form % 0 if float(text) == 0 else text


def table(trims, names):
    """One row per trim, one column per quantity; rungs of the ladder only where one was used."""
    summaries = [values(trim) for trim in trims]
    rescues = sorted({name for summary in summaries for name, value in summary.items()
                      if name.startswith("Rescued") and value > 0})
    columns = COLUMNS + [(name, name, "%d") for name in rescues]
    rows = [["trim"] + [title for title, _, _ in columns]]
    for name, summary in zip(names, summaries):
        rows.append([name] + [formatted(summary[array], form) for _, array, form in columns])
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    lines = ["  ".join([row[0].ljust(widths[0])] +
                       [cell.rjust(width) for cell, width in zip(row[1:], widths[1:])])
             for row in rows]
    lines.insert(1, "  ".join("-" * width for width in widths))
    return "\n".join(lines)
