# SPDX-License-Identifier: Apache-2.0
import unittest

from external_command.any_message import WrongType, holds, pack, unpack
from external_command.msg import Any, Pose, RoutingRequest, SpeedCommand, ValetParkingCommand


class AnyMessageTest(unittest.TestCase):
    def setUp(self):
        self.command = ValetParkingCommand(command_id=5, parking_spot_id="p-7",
                                           way_point=[Pose(x=1.5, has_heading=True)])
        self.any = pack(self.command)

    def test_what_was_packed_comes_out_again(self):
        self.assertEqual(self.any.type, "external_command/ValetParkingCommand")
        self.assertTrue(holds(self.any, ValetParkingCommand))
        self.assertEqual(unpack(self.any, ValetParkingCommand), self.command)

    def test_a_message_without_content_is_packed_too(self):
        self.assertEqual(unpack(pack(RoutingRequest()), RoutingRequest), RoutingRequest())

    def test_another_type_is_refused(self):
        self.assertFalse(holds(self.any, SpeedCommand))
        with self.assertRaisesRegex(WrongType, "external_command/ValetParkingCommand, not external_command/Speed"):
            unpack(self.any, SpeedCommand)

    def test_an_empty_any_is_refused(self):
        with self.assertRaisesRegex(WrongType, "nothing"):
            unpack(Any(), SpeedCommand)

    def test_another_version_of_the_type_is_refused(self):
        self.any.md5sum = "0" * 32
        self.assertFalse(holds(self.any, ValetParkingCommand))
        with self.assertRaisesRegex(WrongType, "md5"):
            unpack(self.any, ValetParkingCommand)

    def test_data_cut_short_at_any_place_is_refused(self):
        data = self.any.data
        for size in range(len(data)):
            self.any.data = data[:size]
            with self.assertRaisesRegex(WrongType, "broken"):
                unpack(self.any, ValetParkingCommand)

    def test_data_with_a_surplus_is_refused(self):
        self.any.data += b"\0"
        with self.assertRaisesRegex(WrongType, "broken"):
            unpack(self.any, ValetParkingCommand)

    def test_what_is_no_message_is_not_packed(self):
        for thing in (None, "text", 5, Pose):
            with self.assertRaisesRegex(WrongType, "ROS message is needed"):
                pack(thing)

    def test_a_message_with_a_field_of_the_wrong_type_is_not_packed(self):
        with self.assertRaisesRegex(WrongType, "cannot be packed"):
            pack(Pose(x="here"))


if __name__ == "__main__":
    unittest.main()
