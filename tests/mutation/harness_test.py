"""The harness finds planted faults, and none where there is none."""
import json
import random
import tempfile
import unittest
from pathlib import Path

import seeds
from damage import damaged
from fault_injection import difference, without_times
from judge import judge
from mutation import Place, Tally, Trial, one_trial
from server import Outcome

INFO = ["info", "v.mha", "--json", "--quiet"]
SOUND = '{"spacing_mm": [2.0, 2.5, 3.0], "value_range": [0, 1]}'


def outcome(code=0, out=SOUND, err="", cpu_ms=10, memory_kb=1000, runs_before=0):
    return Outcome(code, cpu_ms, memory_kb, 0, 0, out, err, runs_before)


class Judge(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.addCleanup(self.place.cleanup)
        self.folder = Path(self.place.name)
        (self.folder / "v.mha").write_bytes(seeds.meta_image(seeds.voxels(), False))

    def found(self, words=None, **facts):
        return judge(outcome(**facts), words or INFO, self.folder)

    def test_sound_outcomes_are_no_findings(self):
        self.assertEqual(self.found(), [])
        self.assertEqual(self.found(code=3, out="", err="error: v.mha: is cut short\n"), [])
        self.assertEqual(self.found(code=2, out="", err="warning: a\nerror: b\n"), [])

    def test_each_fault_is_a_finding(self):
        for facts, what in [({"code": -11}, "crash"), ({"code": -24}, "hang"),
                            ({"cpu_ms": 20_001}, "hang"), ({"memory_kb": 5 << 20}, "memory"),
                            ({"code": 70, "err": "error: unexpected\n"}, "exit 70"),
                            ({"code": 99}, "crash"), ({"code": 3, "out": ""}, "no error line"),
                            ({"err": "libpng warning: x\n"}, "foreign line"),
                            ({"out": '{"a": NaN}'}, "stdout is no JSON"),
                            ({"out": '{"a": null}'}, "number that is not finite"),
                            ({"out": '{"length_mm": 1e34}'}, "absurd number")]:
            found = self.found(**facts)
            self.assertTrue(found and found[0].startswith(what), (facts, found))

    def test_geometry_that_the_file_does_not_state_is_invented(self):
        self.assertIn("invented geometry",
                      self.found(out='{"spacing_mm": [1, 1, 1], "value_range": [0, 1]}')[0])
        text = (self.folder / "v.mha").read_bytes().replace(b"ElementSpacing", b"ElementSpaceing")
        (self.folder / "v.mha").write_bytes(text)
        self.assertIn("invented geometry", self.found()[0])

    def test_files_left_behind_are_findings(self):
        (self.folder / ".o.svg.12-3.part").write_text("half")
        self.assertIn("left behind", self.found()[0])

    def test_coordinates_that_are_no_numbers_are_findings(self):
        words = ["export", "m.ply", "--out", "o.obj"]
        (self.folder / "o.obj").write_text("v 1 2 3\nv nan 0 0\n")
        self.assertIn("not finite", self.found(words=words, out="")[0])

    def test_an_image_within_a_drawing_is_no_number(self):
        words = ["slice", "v.mha", "--out", "o.svg"]
        (self.folder / "o.svg").write_text('<image href="data:image/png;base64,ab/Nan+/=inf/"/>')
        self.assertEqual(self.found(words=words, out=""), [])
        (self.folder / "o.svg").write_text('<line x1="nan"/>')
        self.assertIn("not finite", self.found(words=words, out="")[0])


class FakeServer:
    """Answers by the way to exit."""

    def __init__(self, **answers):
        self.answers, self.asked = answers, []

    def run(self, words, folder, seconds, exits):
        self.asked.append(exits)
        return self.answers[exits]


class KeptProcess(unittest.TestCase):
    """What is found behind other runs is tried again alone."""

    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        root = Path(place.name)
        (root / "mha").mkdir()
        (root / "mha/v.mha").write_bytes(seeds.meta_image(seeds.voxels(), False))
        form = seeds.Form("mha", "mha", ["v.mha"], [["info", "v.mha", "--quiet"]])
        self.place = Place(form, root, root / "job")
        self.trial = Trial([form], root, 1, 1)

    def found(self, **answers):
        server = FakeServer(**answers)
        return one_trial(self.trial, server, self.place, 20)[1], server.asked

    def test_sound_outcomes_are_run_once(self):
        self.assertEqual(self.found(kept=outcome()), ([], ["kept"]))

    def test_a_finding_of_the_input_is_told_as_such(self):
        crash = dict(code=-11, out="")
        self.assertEqual(self.found(kept=outcome(runs_before=3, **crash), quick=outcome(**crash)),
                         (["crash: signal 11"], ["kept", "quick"]))

    def test_a_finding_that_needs_other_runs_is_one_too(self):
        self.assertEqual(self.found(kept=outcome(code=-11, runs_before=3), quick=outcome())[0],
                         ["behind 3 other runs: crash: signal 11"])

    def test_the_first_run_of_a_process_is_alone_already(self):
        self.assertEqual(self.found(kept=outcome(code=-11))[1], ["kept"])

    def test_counts_are_kept(self):
        file = Path(self.place.folder) / "counts.json"
        tally = Tally()
        tally.add(self.trial, outcome(code=3), ["hang"])
        tally.save(file)
        record = json.loads(file.read_text())
        self.assertEqual((record["runs"], record["exit_codes"], record["forms"], record["findings"]),
                         (1, {"3": 1}, {"mha": 1}, ["run 1: hang"]))
        self.assertIn("1 with 3", tally.line())


class Places(unittest.TestCase):
    """A folder is kept from run to run, as if it were made anew."""

    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        root = Path(place.name)
        (root / "case/part").mkdir(parents=True)
        for name in ("case/a.txt", "case/part/b.txt"):
            (root / name).write_text("sound")
        form = seeds.Form("form", "case", ["a.txt"], [["info", "a.txt"]])
        self.place = Place(form, root, root / "job")
        self.folder = root / "job"

    def content(self):
        return {str(file.relative_to(self.folder)): file.read_text()
                for file in self.folder.rglob("*") if file.is_file()}

    def assert_restored(self, written=()):
        self.assertEqual(self.place.restore("a.txt"), list(written))
        self.assertEqual(self.content(), {"a.txt": "sound", "part/b.txt": "sound"})

    def test_damage_and_results_go(self):
        self.place.damage("a.txt", b"damaged")
        self.assertEqual(self.content(), {"a.txt": "damaged", "part/b.txt": "sound"})
        (self.folder / "o/p").mkdir(parents=True)
        (self.folder / "o/p/q.txt").write_text("result")
        self.assert_restored()

    def test_a_file_that_a_run_replaced_or_removed_comes_back(self):
        (self.folder / "part/b.txt").unlink()
        self.assert_restored()
        (self.folder / "part/b.txt").unlink()
        (self.folder / "part/b.txt").write_text("other")
        self.assert_restored()
        (self.folder / "a.txt").unlink()
        self.assert_restored()

    def test_a_seed_that_was_written_into_is_named(self):
        with open(self.folder / "part/b.txt", "a", encoding="utf-8") as file:
            file.write(" no more")
        self.assertEqual(self.place.restore("a.txt"), ["part/b.txt"])


class Damage(unittest.TestCase):
    def test_it_is_the_seeds_and_changes_nearly_every_file(self):
        sound = seeds.meta_image(seeds.voxels(), False)
        again = [damaged(sound, random.Random(i)) for i in range(200)]
        self.assertEqual(again, [damaged(sound, random.Random(i)) for i in range(200)])
        self.assertGreater(sum(one != sound for one in again), 190)
        self.assertGreater(len(set(again)), 150)


class Faults(unittest.TestCase):
    def test_a_difference_is_told_and_clocks_are_none(self):
        self.assertEqual(difference({"a": 1}, {"a": 1}), "")
        self.assertEqual(difference({"a": 1, ".p.part": 2}, {"a": 2, "b": 3}),
                         "left behind .p.part; missing b; other bytes a")
        for name, one, other in [("run.json", b'{"x": 1, "mean_ms": 4}', b'{"x": 1, "mean_ms": 5}'),
                                 ("frames.csv", b"frame,fuse_ms\n0,4", b"frame,fuse_ms\n0,5")]:
            self.assertEqual(without_times(name, one), without_times(name, other))
        self.assertNotEqual(without_times("run.json", b'{"x": 1}'), without_times("run.json", b'{"x": 2}'))


if __name__ == "__main__":
    unittest.main()
