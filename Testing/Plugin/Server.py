"""Runs a client's script against a pvserver that loads the plugin too; plain Python.

Arguments: the client's script, and the command that starts the server on several ranks, if any.
"""
import re
import subprocess
import sys

server = subprocess.Popen(sys.argv[2:] + ["pvserver", "--server-port=0"], stdout=subprocess.PIPE,
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
    client = subprocess.run(["pvpython", "--dr", sys.argv[1], found.group(1)])
    # The server ends with its client.
    print(server.communicate(timeout=60)[0])
finally:
    if server.poll() is None:
        server.kill()
sys.exit(client.returncode or server.returncode)
