"""Runs ServerClient.py against a pvserver on two ranks; plain Python.

Arguments: the command that starts a program on two ranks.
"""
import os
import re
import subprocess
import sys

server = subprocess.Popen(sys.argv[1:] + ["pvserver", "--server-port=0"], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True)
try:
    said = ""
    for line in server.stdout:
        said += line
        found = re.search(r"Accepting connection\(s\): \S+:(\d+)", line)
        if found:
            break
    else:
        sys.exit("The server did not say where it listens:\n" + said)
    client = subprocess.run(["pvpython", "--dr",
                             os.path.join(os.path.dirname(__file__), "ServerClient.py"),
                             found.group(1)])
    # The server ends with its client.
    print(server.communicate(timeout=60)[0])
finally:
    if server.poll() is None:
        server.kill()
sys.exit(client.returncode or server.returncode)
