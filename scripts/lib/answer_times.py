# SPDX-License-Identifier: Apache-2.0
"""How late an answer may come while several callers let the gateway plan at once."""
import math
import os

MOTION_SERVICES = ("free_space", "lane_follow", "path_follow", "precise_parking", "valet_parking", "zone_cover")
ANSWER_LIMIT = 5.0  # of a request that nobody is ahead of: LONGEST_PLAN, and some time on a machine that is busy [s]
LONGEST_PLAN = 3.0  # by the default of coverage/time_budget [s]
WAITING = 6  # requests of its kind that may be ahead of one, by the default of planning_queue
COMMAND_THREADS = 2


def latest_answer(service, is_dry_run=True, limit=ANSWER_LIMIT, cores=None):
    """[s] for one request to `service`: `limit`, and as long as plans may take for those ahead of it in the line."""
    if service not in MOTION_SERVICES:
        return limit
    threads = max(1, (cores or os.cpu_count()) - 1) if is_dry_run else COMMAND_THREADS
    return limit + LONGEST_PLAN * math.ceil(WAITING / threads)
