"""A trim is aborted in the real window, by the button and by Escape, and applied again; a comparison
is aborted."""
import shutil
import sys

from Window import MAIN, Window

HEIGHT = 900
BUTTON = MAIN + "/statusbar/1pqProgressWidget0/AbortButton"
APPLY = MAIN + "/propertiesDock/propertiesPanel/Accept"

if not shutil.which("xdotool"):
    print("Not run: no xdotool here; it is in Debian's package of that name.")
    sys.exit(77)

window = Window(size=(1400, HEIGHT))


def abort(how, action):
    # Messages of before may be in front of the button.
    window.event(MAIN + "/outputWidgetDock/qt_dockwidget_closebutton", "activate")
    window.python("user = by_hand(%r, %r, %r)" % (sys.executable, how, HEIGHT))
    action()
    window.python("check_equal(user.wait(), 0, 'the user by hand')")


def expect_aborted(times):
    """Nothing is there, and nothing is done until Apply is clicked."""
    window.expect(BUTTON, "enabled", "false")
    window.expect(APPLY, "enabled", "true")
    window.python("check_equal(active().GetXMLName(), 'TrimHexahedralGrid', 'selected')\n"
                  "check_equal(elements(active()), 0, 'elements after an abort')\n"
                  "runs = len(starts)\n"
                  "GetActiveView().CameraPosition = [%d, 300, 200]\n"
                  "Render()\n"
                  "check_equal(len(starts), runs, 'trims that nobody asked for')" % times)


window.open("block.vtu")
window.apply()
window.open("aslant.igs")
window.apply()
window.select("0:0/0:0")
window.menu("menuFilters", "NURBSTrim", "TrimHexahedralGrid")
window.choose_inputs(TrimmingSurface="0:0/1:0")
window.set_check("InsertLayer", True)
window.python("starts = count_starts(active())")
window.expect(BUTTON, "enabled", "false")

# The first time: all is as before Apply.
abort("button", window.apply)
window.picture("aborted.png")
expect_aborted(1)
window.python("check_equal([is_shown(name) for name in ('block.vtu', 'aslant.igs', "
              "'TrimHexahedralGrid1')], [True, True, False], 'shown after an abort')")
window.python("starts.clear()")
window.apply()
window.python("whole = summary(active())\n"
              "check(whole['InsertedElements'] > 0 and elements(active()) == "
              "whole['Kept'] + whole['InsertedElements'], 'result after an abort')\n"
              "check_equal(len(starts), 1, 'trims by Apply')\n"
              "check_equal(is_shown('TrimHexahedralGrid1'), True, 'shown')\n"
              "check_first_view()")

# Again, with other values.
window.set_check("InvertSide", True)
abort("Escape", window.apply)
expect_aborted(2)
window.apply()
window.python("other = summary(active())\n"
              "check(abs(other['Kept'] + whole['Kept'] - 36 ** 3) < 0.02 * 36 ** 3, 'other side')\n"
              "check_equal(repr(other), repr(anew(active())), 'summary after an abort')")
window.expect(BUTTON, "enabled", "false")

# A comparison: nothing of it stays.
window.python("SetActiveSource(FindSource('TrimHexahedralGrid1'))")
window.expect_action("CompareCorrectionTypes", True)
abort("button", lambda: window.action("CompareCorrectionTypes"))
window.python("check_equal(FindSource('TypeI'), None, 'a trim of a comparison')\n"
              "check_equal(GetLayoutByName('Correction Types'), None, 'the layout of a comparison')\n"
              "check_equal(repr(summary(active())), repr(other), 'the trim compared')")
told = window.run("abort")
if [told.count(text) for text in ("| Aborted: TrimHexahedralGrid1.", "| Aborted.", "Pressed: ")] != [2, 1, 3]:
    sys.exit("ERROR: one message for each abort, not:\n" + told)
