# SPDX-License-Identifier: Apache-2.0
"""To be imported beside rospy: that of Debian 11 asks threads by a name that its Python does not have any more, and
prints a traceback when a program ends."""
import threading

if not hasattr(threading.Thread, "isAlive"):
    threading.Thread.isAlive = threading.Thread.is_alive
