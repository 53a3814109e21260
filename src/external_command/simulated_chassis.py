# SPDX-License-Identifier: Apache-2.0
"""The chassis of the simulated vehicle: driving mode, lights and horn, identification. No ROS communication in here."""

import dataclasses

from external_command.msg import Chassis, ControlPad, VehicleSignal

_SIGNAL_FIELDS = ("turn_signal", "high_beam", "low_beam", "horn", "emergency_light")


@dataclasses.dataclass(frozen=True)
class ChassisSettings:
    driving_mode: str = "auto"  # at the start: auto or manual
    mode_switch_delay: float = 0.2  # [s]
    ignored_mode_switches: int = 0  # this many requests to switch the mode are ignored first; -1: every one
    vin: str = "SIMULATED00000001"

    def __post_init__(self):
        if self.driving_mode not in ("auto", "manual"):
            raise ValueError("driving_mode is %s; it must be auto or manual" % self.driving_mode)


class SimulatedChassis:
    def __init__(self, settings):
        self.mode = Chassis.COMPLETE_AUTO_DRIVE if settings.driving_mode == "auto" else Chassis.COMPLETE_MANUAL
        self.vin = ""  # until it is asked for
        self.signal = VehicleSignal(turn_signal=VehicleSignal.TURN_NONE, high_beam=VehicleSignal.OFF,
                                    low_beam=VehicleSignal.OFF, horn=VehicleSignal.OFF,
                                    emergency_light=VehicleSignal.OFF)
        self._settings = settings
        self._switches_to_ignore = settings.ignored_mode_switches
        self._switch = None  # (mode, seconds left)
        self._stopped = False  # by ControlPad.STOP, until START or RESET

    @property
    def obstacle(self):
        """Why the vehicle does not drive by itself; empty where it does."""
        if self._stopped:
            return "the control module was stopped, switch to auto to go on"
        return "" if self.mode == Chassis.COMPLETE_AUTO_DRIVE else "the vehicle is in manual mode, switch to auto"

    @property
    def is_switching(self):
        return self._switch is not None

    def accept_pad(self, action):
        """An action of ControlPad."""
        if action == ControlPad.STOP:
            self._stopped = True
        elif action == ControlPad.VIN_REQ:
            self.vin = self._settings.vin
        elif action in (ControlPad.START, ControlPad.RESET):
            self._begin_switch(Chassis.COMPLETE_AUTO_DRIVE if action == ControlPad.START else Chassis.COMPLETE_MANUAL)

    def accept_command(self, command):
        """A ChassisCommand; its custom operation means nothing to this vehicle. 0 keeps what is."""
        for field in _SIGNAL_FIELDS:
            value = getattr(command.basic_signal, field)
            if value != VehicleSignal.KEEP:
                setattr(self.signal, field, value)

    def step(self, dt):
        if not self._switch:
            return
        mode, left = self._switch
        if left > dt:
            self._switch = (mode, left - dt)
            return
        self.mode = mode
        self._stopped = False
        self._switch = None

    def _begin_switch(self, mode):
        if self._switches_to_ignore != 0:
            self._switches_to_ignore -= 1
        elif not self._switch or self._switch[0] != mode:
            self._switch = (mode, self._settings.mode_switch_delay)
