"""Both scripts in one start of pvbatch, which takes longer than either."""
import os
import runpy

for script in ("Pieces.py", "Proxies.py"):
    runpy.run_path(os.path.join(os.path.dirname(os.path.abspath(__file__)), script),
                   run_name="__main__")
