"""hangup.py PROGRAM ARGUMENTS...: runs the program on a terminal and closes that at work.

Prints the exit code.
"""
import os
import pty
import sys
import time


def catches_hangup(process):
    """Has the process a handler for SIGHUP (number 1, so bit 0 of `SigCgt`, proc(5))?"""
    with open(f"/proc/{process}/status") as status:
        mask = next(line for line in status if line.startswith("SigCgt:"))
    return int(mask.split()[1], 16) & 1


process, terminal = pty.fork()
if process == 0:
    os.execv(sys.argv[1], sys.argv[1:])

while not catches_hangup(process):
    time.sleep(0.01)
time.sleep(0.1)
os.close(terminal)

_, status = os.waitpid(process, 0)
print(os.waitstatus_to_exitcode(status))
