"""A window with the plugin on a server without it: what the menu NURBSTrim cannot do there is greyed out
and says why."""
import os

from Server import server
from Window import MAIN, Window

NO_PLUGIN = ("The server has not loaded the plugin NURBSTrim: Tools > Manage Plugins, Remote "
             "Plugins.")

environment = {name: value for name, value in os.environ.items() if name != "PV_PLUGIN_PATH"}
with server(environment=environment) as running:
    window = Window()
    window.python("Connect('localhost', %s)" % running.port)
    window.open("sheet.vtu")
    window.apply()
    window.python("mesh = active()\nball = Sphere()")
    # The mesh alone, to draw on, and with a surface, to be trimmed.
    for selected in ("mesh", "mesh, ball"):
        window.python("select(%s)" % selected)
        for action in ("DrawTrimLine", "CompareCorrectionTypes"):
            window.expect_action(action, False, NO_PLUGIN)
    window.run("plugin-on-client")
    print(running.communicate(timeout=60)[0])
