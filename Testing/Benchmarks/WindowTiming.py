"""Where the time of an Apply goes; runs in the window's own process.

A part is timed from its start event to its end event: the trim, the line, the extraction of the
surface that is drawn, the drawing. The rest is ParaView's own: it looks for the ranges of the
surface's arrays, updates its panels. Seconds on the clock, and of the processor in all threads of
the process, those of the software OpenGL among them.
"""
import statistics
import time

from paraview.simple import GetActiveView, GetDisplayProperties, Hide, Render, Show

PARTS = ("filter", "surface", "drawing", "rest")


def now():
    return time.perf_counter(), time.process_time()


class Parts:
    """Sums up what lies between start and end events."""

    def __init__(self):
        self.spent = {}
        self.since = None
        self.names = {}

    def watch(self, name, algorithm):
        self.names[id(algorithm)] = (name, algorithm)  # the wrapper lives as long as this
        algorithm.AddObserver("StartEvent", lambda *_: self.start())
        algorithm.AddObserver("EndEvent", lambda *_: self.end(name))

    def start(self):
        self.since = now()

    def end(self, name):
        if self.since is None:
            return
        old = self.spent.get(name, (0.0, 0.0))
        self.spent[name] = tuple(a + b - c for a, b, c in zip(old, now(), self.since))
        self.since = None


class Timing:
    """Of several rounds of one and the same action: the median of each part."""

    def __init__(self, what, sources):
        """sources: whatever is executed; the last one is what is shown."""
        self.what = what
        self.rounds = []
        self.nothing = []
        self.parts = Parts()
        view = GetActiveView()
        for source in sources:
            self.parts.watch("filter", source.SMProxy.GetClientSideObject())
        shown = GetDisplayProperties(sources[-1], view).SMProxy.GetClientSideObject()
        self.parts.watch("surface", shown.GetActiveRepresentation())
        self.parts.watch("drawing", view.SMProxy.GetClientSideObject().GetRenderWindow())

    def begin(self):
        self.parts.spent = {}
        self.started = now()

    def end_of_nothing(self):
        """What the way of measuring takes by itself, which does not count."""
        self.nothing.append([b - a for a, b in zip(self.started, now())])

    def end(self):
        whole = [b - a for a, b in zip(self.started, now())]
        if self.nothing:
            whole = [a - statistics.median(b) for a, b in zip(whole, zip(*self.nothing))]
        spent = dict(self.parts.spent)
        spent["rest"] = tuple(
            whole[i] - sum(part[i] for part in self.parts.spent.values()) for i in (0, 1))
        spent["whole"] = tuple(whole)
        self.rounds.append(spent)

    def table(self):
        lines = [self.what]
        for name in PARTS + ("whole",):
            seconds = [statistics.median(spent.get(name, (0.0, 0.0))[i] for spent in self.rounds)
                       for i in (0, 1)]
            lines.append("  %-8s %6.3f s, processor %6.3f s" % (name, *seconds))
        without = [statistics.median(spent["whole"][i] - spent["drawing"][i]
                                     for spent in self.rounds) for i in (0, 1)]
        lines.append("  %-8s %6.3f s, processor %6.3f s" % ("undrawn", *without))
        return "\n".join(lines)


def show_alone(source):
    """Like the window's own Show, coloured as it comes, everything else hidden."""
    view = GetActiveView()
    for shown in view.Representations:
        if hasattr(shown, "Input"):
            Hide(shown.Input, view)
    Show(source, view).Representation = "Surface With Edges"
    Render()


def time_changes(what, source, changes):
    """One of ParaView's own filters: after each change the view is drawn anew."""
    show_alone(source)
    timing = Timing(what, [source])
    for change in changes:
        timing.begin()
        change()
        Render()
        timing.end()
    return timing.table()
