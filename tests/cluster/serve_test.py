"""Browsers at a real master: what they see and what they may do.

No waiting by time, but for one check that nothing comes while an update is not shown.
"""
import re
import subprocess
import unittest

from browser import ServeTest, request
from png import read as read_png
from programs import BIN, eventually, signal

UNDO, ESCAPE = ord("Z"), 256


class Sees(ServeTest):
    def test_the_page_and_a_picture_that_converges(self):
        self.serve()
        status, fields, page = request("127.0.0.1", self.port)
        self.assertEqual((status, fields["content-type"]), (200, "text/html; charset=utf-8"))
        self.assertIn("default-src 'none'", fields["content-security-policy"])
        self.assertIn(b"<canvas", page)
        viewer = self.view()
        head = self.at_rest(viewer, 3)
        self.assertEqual(viewer.picture[:3], b"\xff\xd8\xff")  # JPEG
        self.assertEqual((head["you"], head["control"], head["viewers"]), (1, 1, 1))
        self.assertEqual(head["view"], "beauty")
        self.assertEqual(len(head["clients"]), 1)
        viewer.look_until(lambda head: head["error"] is not None and head["error"] < 0.5)

    def test_nothing_comes_while_an_update_is_not_shown(self):
        self.serve()
        viewer = self.view()
        self.at_rest(viewer)
        viewer.look(shows=False)
        self.assertFalse(viewer.wait(1))
        viewer.send("shown")
        viewer.look()

    def test_a_late_viewer_sees_what_the_others_see(self):
        self.serve()
        self.at_rest(self.view())
        late = self.view()
        late.look_until(lambda head: head["viewers"] == 2)
        self.at_rest(late)
        self.assertTrue(late.picture)

    def test_files_are_whole(self):
        self.serve()
        viewer = self.view()
        self.at_rest(viewer)
        for kind, magic in ("png", b"\x89PNG\r\n\x1a\n"), ("exr", b"\x76\x2f\x31\x01"):
            viewer.send(f"download {kind}")
            viewer.look_until(lambda head: head.get("file") == f"table_room.{kind}")
            data = viewer.files[f"table_room.{kind}"]
            self.assertEqual(data[:len(magic)], magic)
            (self.folder / f"saved.{kind}").write_bytes(data)
        width, height, *_ = read_png(self.folder / "saved.png")
        self.assertEqual((width, height), (96, 72))
        done = subprocess.run([BIN / "ninefold-compare", "saved.exr", "saved.exr"], cwd=self.folder,
                              stdout=subprocess.DEVNULL)
        self.assertEqual(done.returncode, 0)

    def test_metrics_count(self):
        self.serve()
        self.at_rest(self.view())

        def frames():
            status, _, body = self.metrics()
            self.assertEqual(status, 200)
            found = dict(re.findall(r"^(ninefold_\S+) (\S+)$", body.decode(), re.M))
            self.assertEqual(found["ninefold_viewers"], "1")
            self.assertEqual(found['ninefold_clients{state="ready"}'], "1")
            return float(found["ninefold_frames_total"]) >= 2 and float(found['ninefold_rays_total{kind="shadow"}']) > 0
        eventually(frames, "frames and rays in /metrics")


class Acts(ServeTest):
    def test_the_camera_moves_by_pointer_and_keys(self):
        self.serve()
        viewer = self.view()
        self.at_rest(viewer)
        viewer.send("button down right 40 40 -")
        viewer.send("move 60 40 -")
        viewer.look_until(lambda head: head["moving"])
        viewer.send("button up right 60 40 -")
        self.at_rest(viewer)
        viewer.send("key down 87 -")
        viewer.look_until(lambda head: head["moving"])
        viewer.send("key up 87 -")
        self.at_rest(viewer)

    def test_view_and_exposure(self):
        self.serve()
        viewer = self.view()
        self.at_rest(viewer)
        viewer.send("view depth")
        viewer.look_until(lambda head: head["view"] == "depth")
        viewer.send("exposure -2.5")
        viewer.look_until(lambda head: head["exposure"] == -2.5)
        viewer.send("exposure auto")
        viewer.look_until(lambda head: head["auto"])

    def test_select_switch_and_undo(self):
        """The table room's lamp hangs in the upper half: whatever is clicked at is something of the scene."""
        self.serve()
        viewer = self.view()
        self.at_rest(viewer)
        viewer.click(48, 50)
        name = viewer.look_until(lambda head: head.get("selection"))["selection"]
        self.expect_line(f"selected {re.escape(name)}")
        viewer.send("button down left 48 50 -")
        viewer.send("move 60 50 -")
        viewer.look_until(lambda head: head["moving"])
        viewer.send("button up left 60 50 -")
        self.at_rest(viewer)
        viewer.press(UNDO, "c")
        viewer.look_until(lambda head: head["moving"])
        self.at_rest(viewer)
        viewer.press(ESCAPE)
        viewer.look_until(lambda head: head["selection"] is None)

    def test_keys_that_save_do_nothing_at_the_master(self):
        self.serve()
        viewer = self.view()
        self.at_rest(viewer)
        before = sorted(self.folder.iterdir())
        for key, held in (ord("P"), "-"), (ord("S"), "c"), (ord("Q"), "c"):
            viewer.press(key, held)
        viewer.send("view albedo")
        viewer.look_until(lambda head: head["view"] == "albedo")
        self.assertEqual(sorted(self.folder.iterdir()), before)

    def test_control_is_handed_over(self):
        self.serve()
        first, second = self.view(), self.view()
        self.at_rest(first)
        second.look_until(lambda head: head["viewers"] == 2)
        one, other = first.head["you"], second.head["you"]
        second.send("view depth")  # not heard
        second.send("ask")
        first.look_until(lambda head: head["asking"] == [other])
        self.assertEqual(first.head["view"], "beauty")
        first.send("give")
        second.look_until(lambda head: head["control"] == other)
        second.send("view depth")
        second.look_until(lambda head: head["view"] == "depth")
        second.close()
        first.look_until(lambda head: head["control"] == one and head["viewers"] == 1)

    def test_who_leaves_lets_go(self):
        self.serve()
        first, second = self.view(), self.view()
        self.at_rest(first)
        self.at_rest(second)
        first.send("key down 68 -")
        second.look_until(lambda head: head["moving"])
        first.close()
        self.at_rest(second)

    def test_the_last_picture_is_written_at_the_end(self):
        self.serve("--output", "last.png")
        self.at_rest(self.view())
        self.master.process.send_signal(signal.SIGTERM)
        self.assertEqual(self.master.ends(), 143, self.master.text)
        self.assertEqual(read_png(self.folder / "last.png")[:2], (96, 72))


class Replayed(ServeTest):
    def test_recorded_clients_answer_a_session(self):
        """Its first frame asks for planes that the others lack: objects and distances, for clicks."""
        key = "--key-file", "cluster.key"
        subprocess.run([BIN / "ninefold-master", "--new-key", "cluster.key"], cwd=self.folder, check=True, capture_output=True)
        self.serve(*key, clients=0)
        client = self.start(BIN / "ninefold-client", "--master", self.address_of(self.master), *key, "--threads", 1, "--cache",
                            "none", "--record", "session.recording")
        self.at_rest(self.view(), 4)
        self.master.process.send_signal(signal.SIGTERM)
        self.assertEqual(client.ends(), 0, client.text)
        self.serve(*key, clients=0)
        replay = self.start(BIN / "ninefold-replay-client", "--master", self.address_of(self.master), *key, "--recording",
                            "session.recording", "--clients", 3)
        viewer = self.view()
        self.at_rest(viewer, 12)
        viewer.click(48, 36)
        viewer.look_until(lambda head: head["selection"])
        self.master.process.send_signal(signal.SIGTERM)
        self.assertEqual(replay.ends(), 0, replay.text)


if __name__ == "__main__":
    unittest.main()
