# SPDX-License-Identifier: Apache-2.0
"""Whether there is a ROS master to talk to."""

import rosgraph


def missing_master():
    """None where the master answers; else a line that says where none does."""
    try:
        if rosgraph.is_master_online():
            return None
    except ValueError:  # what is set is no address
        pass
    return "no ROS master at '%s' (ROS_MASTER_URI)" % rosgraph.get_master_uri()
