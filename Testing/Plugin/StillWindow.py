"""Whether the window stood still while something was built up in it: it is looked at whenever a proxy
is registered."""
from paraview import servermanager

from Checks import check

AREA = slice(430, 860), slice(0, 1380)  # below what menus cover; part of the panel and of the view


class StillWindow:
    def __init__(self, screen):
        self.screen = screen
        self.first = None
        self.changed = []
        self.manager = servermanager.ActiveConnection.Session.GetSessionProxyManager()
        self.tag = self.manager.AddObserver("RegisterEvent", self.look)

    def look(self, *_):
        picture = self.screen()[AREA].copy()
        if self.first is None:
            self.first = picture
        self.changed.append(int((picture != self.first).any(axis=2).sum()))

    def check(self):
        self.manager.RemoveObserver(self.tag)
        check(len(self.changed) > 10, "%d proxies registered" % len(self.changed))
        # The mouse's pointer may be other, no more.
        check(max(self.changed) < 2000, "pixels that changed on the way: %r" % self.changed)
