"""Runs a client's script against a pvserver that loads the plugin too; plain Python.

Arguments: the client's script, and the command that starts the server on several ranks, if any.
"""
import contextlib
import re
import subprocess
import sys


@contextlib.contextmanager
def server(*launcher, environment=None):
    """A pvserver, with its port as the attribute port; it is ended if it does not end with its client."""
    process = subprocess.Popen([*launcher, "pvserver", "--server-port=0"], stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, text=True, env=environment)
    try:
        said = ""
        for line in process.stdout:
            said += line
            found = re.search(r"Accepting connection\(s\): \S+:(\d+)", line)
            if found:
                break
        else:
            sys.exit("The server did not say where it listens:\n" + said)
        process.port = found.group(1)
        yield process
    finally:
        if process.poll() is None:
            process.kill()


if __name__ == "__main__":
    with server(*sys.argv[2:]) as running:
        client = subprocess.run(["pvpython", "--dr", sys.argv[1], running.port])
        # The server ends with its client.
        print(running.communicate(timeout=60)[0])
    sys.exit(client.returncode or running.returncode)
