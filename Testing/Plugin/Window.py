"""Drives ParaView's real window: a script of steps that a user could do by mouse, and checks.

    window = Window()
    window.open("sheet.vtu")
    window.apply()
    window.python("check_equal(summary(active())['Kept'], 192, 'Kept')")
    window.picture("kept.png")
    window.run("kept")

The steps become a test script of ParaView (XML), which the window plays under the display it is
started in. Python given to python() runs in the window's own Python shell, with the names of
WindowSession, so that it sees the numbers that the user sees. run() ends the process with an
error if a step could not be done, if a check failed, or if ParaView reported an error.
"""
import os
import re
import subprocess
import sys
from xml.sax.saxutils import quoteattr

MAIN = "pqClientMainWindow"
PANEL = (MAIN + "/propertiesDock/propertiesPanel/scrollArea/qt_scrollarea_viewport/"
         "scrollAreaWidgetContents/PropertiesFrame/ProxyPanel/")
SHELL = MAIN + "/pythonShellDock/pythonShell/consoleWidget"
VIEWS = (MAIN + "/centralwidget/MultiViewWidget/CoreWidget/qt_tabwidget_stackedwidget/"
         "MultiViewWidget1/Container/")
ACTIONS = ("DrawTrimLine", "ShowSummary", "ShowStatuses", "CompareCorrectionTypes")

OUTPUT_DIRECTORY = os.environ["NURBSTRIM_OUTPUT"]
ERROR = re.compile(r"ERR\||ERROR:|Traceback|Widget not found|[Cc]ould not find|Unhandled")


class Window:
    def __init__(self, size=(1300, 850)):
        self.size = size
        self.steps = []
        self.python("from WindowSession import *")

    def event(self, widget, command, arguments=""):
        """One event on a widget, named by the path of its object names below the main window."""
        self.steps.append("  <pqevent object=%s command=%s arguments=%s />"
                          % (quoteattr(widget), quoteattr(command), quoteattr(arguments)))

    def expect(self, widget, name, value):
        """The widget's Qt property has this value."""
        self.steps.append("  <pqcheck object=%s property=%s arguments=%s />"
                          % (quoteattr(widget), quoteattr(name), quoteattr(value)))

    def python(self, code):
        self.event(SHELL, "executeCommand", "run(%r)" % code if self.steps else code)

    def pause(self, milliseconds):
        self.event(MAIN, "pause", str(milliseconds))

    def menu(self, *path):
        """Activates the last of the menus' and the action's names, e.g. "menuFilters", ..."""
        widget = MAIN + "/menubar"
        for name in path:
            self.event(widget, "activate", name)
            widget += "/" + name

    def action(self, name):
        """An action of the menu NURBSTrim."""
        self.event(MAIN + "/menubar", "activate", "NURBSTrim")
        self.event(MAIN + "/NURBSTrim", "activate", name)

    def expect_action(self, name, enabled, hint=None):
        """An action of the menu NURBSTrim is enabled, or greyed out for this reason."""
        button = MAIN + "/NURBSTrimToolbar/1QToolButton%d" % ACTIONS.index(name)
        self.expect(button, "enabled", "true" if enabled else "false")
        if hint:
            self.expect(button, "statusTip", hint)

    def open(self, name):
        self.menu("menu_File", "actionFileOpen")
        self.event(MAIN + "/FileOpenDialog", "filesSelected",
                   os.path.join(OUTPUT_DIRECTORY, name))

    def apply(self):
        self.event(MAIN + "/propertiesDock/propertiesPanel/Accept", "activate")

    def select(self, row, browser=MAIN + "/pipelineBrowserDock/pipelineBrowser"):
        """Clicks a line of the Pipeline Browser: its rows from the root, e.g. 0:0/1:0."""
        self.event(browser, "mousePress", "1,1,0,60,10,/" + row)
        self.event(browser, "mouseRelease", "1,0,0,60,10,/" + row)

    def hover(self, kind, x, y, picture=None):
        """Hovers over what is at this place of the view; kind is Points or Cells."""
        frame = VIEWS + "Frame.0/"
        button = frame + "actionHoveringSurface" + kind
        self.event(button, "set_boolean", "true")
        # A box that explains the mode.
        self.event(MAIN + "/1QMessageBox0/qt_msgbox_buttonbox/1QPushButton0", "activate")
        for event, pressed in (("mousePress", 1), ("mouseMove", 0), ("mouseRelease", 0)):
            self.event(frame + "CentralWidgetFrame/Viewport", event,
                       "(%g,%g,1,%d,0)" % (x, y, pressed))
        self.pause(600)
        self.python("hovered = tooltip(%d)" % (kind == "Cells"))
        if picture:
            self.picture(picture)
        self.event(button, "set_boolean", "false")

    def choose_inputs(self, **rows):
        """Fills the dialog that asks for a filter's inputs: property name to browser row."""
        dialog = MAIN + "/SelectInputDialog/"
        for name, row in rows.items():
            self.event(dialog + "buttonFrame/" + name, "set_boolean", "true")
            self.select(row, dialog + "pipelineView")
        self.event(dialog + "buttonBox/1QPushButton0", "activate")

    def set_choice(self, name, text):
        self.event(PANEL + name + "/ComboBox", "activated", text)

    def set_check(self, name, checked):
        self.event(PANEL + name + "/CheckBox", "set_boolean", "true" if checked else "false")

    def set_text(self, widget, text):
        self.event(PANEL + widget, "set_string", text)

    def expect_visible(self, widget, visible):
        self.expect(PANEL + widget, "visible", "true" if visible else "false")

    def picture(self, name):
        """A picture of the whole window, when all is drawn."""
        self.pause(300)
        self.python("save_screen(%r, %d, %d)" % ((name,) + self.size))

    def run(self, name):
        """Plays the steps; returns what the window wrote."""
        script = os.path.join(OUTPUT_DIRECTORY, name + ".xml")
        with open(script, "w") as file:
            file.write('<?xml version="1.0" ?>\n<pqevents>\n%s\n</pqevents>\n'
                       % "\n".join(self.steps))
        done = subprocess.run(["paraview", "-qwindowgeometry", "%dx%d" % self.size, "--dr",
                               "--test-directory=" + OUTPUT_DIRECTORY,
                               "--data-directory=" + OUTPUT_DIRECTORY,
                               "--test-script=" + script, "--exit"],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=200)
        print(done.stdout, flush=True)
        if done.returncode != 0 or ERROR.search(done.stdout):
            sys.exit("ERROR: %s: a step or a check failed" % name)
        return done.stdout
