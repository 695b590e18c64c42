"""The Python module: what it computes, what it shares with NumPy, what it refuses."""
import csv
import filecmp
import os
import shutil
import subprocess
import tempfile
import threading
import unittest
from pathlib import Path

import numpy as np
import softscope

PROGRAM = os.environ["SOFTSCOPE"]
NETWORK = Path(__file__).resolve().parents[1] / "fuzz/corpus/onnx/free.onnx"  # four disparities


class Clip(unittest.TestCase):
    """Six frames of 240 x 180 pixels, reconstructed from NumPy arrays."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.root = Path(cls.folder.name)
        cls.clip = str(cls.root / "clip")
        softscope.simulate(cls.clip, {"frames": 6, "truth_every": 1}, width_px=240, height_px=180)
        cls.sequence = softscope.Sequence(cls.clip)
        cls.calibration = cls.sequence.calibration
        cls.frames = list(cls.sequence)
        cls.made, cls.reports = cls.reconstruct(str(cls.root / "run"))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def reconstruct(cls, out):
        reconstructor = softscope.Reconstructor(cls.calibration)
        reconstructor.record_to(out, save_every=1)
        reports = [reconstructor.process(np.array(frame.left), np.array(frame.right),
                                         time_s=frame.time_s) for frame in cls.frames]
        return reconstructor.finish(), reports


class ProcessesASequence(Clip):
    """The loop with look-ahead: the bytes of the command, and of single pairs."""

    def reconstructor(self, name):
        made = softscope.Reconstructor(self.calibration)
        made.record_to(str(self.root / name), save_every=1)
        return made

    def test_a_damaged_frame_is_reported_and_the_folder_has_the_commands_bytes(self):
        clip = self.root / "damaged"
        shutil.copytree(self.clip, clip)
        (clip / "left" / "000002.png").write_bytes(b"broken")
        reconstructor = self.reconstructor("damaged_run")
        reports = list(reconstructor.process(softscope.Sequence(str(clip))))
        made = Path(reconstructor.finish().folder)
        out = self.root / "damaged_command"
        subprocess.run([PROGRAM, "reconstruct", clip, "--out", out, "--save-every", "1",
                        "--quiet"], check=True, stdout=subprocess.DEVNULL)
        self.assertEqual([report.status for report in reports],
                         ["started", "fused", "unreadable", "fused", "fused", "fused"])
        self.assertIn("000002.png", reports[2].reason)
        files = [{path.relative_to(folder) for path in folder.rglob("*") if path.is_file()}
                 for folder in (made, out)]
        self.assertEqual(files[0], files[1])
        for name in files[0] - {Path("run.json"), Path("frames.csv")}:
            self.assertTrue(filecmp.cmp(made / name, out / name, False), name)
        tables = [list(csv.DictReader((folder / "frames.csv").open())) for folder in (made, out)]
        for row in tables[0] + tables[1]:
            for column in [column for column in row if column.endswith("_ms")]:
                del row[column]
        self.assertEqual(tables[0], tables[1])

    def test_the_sequence_has_settings_and_warnings(self):
        later = softscope.Sequence(self.clip, sequence_right_offset=1)
        self.assertTrue((next(later).right == self.frames[1].right).all())
        self.assertEqual(later.warnings, [])  # stated, not estimated
        with self.assertRaisesRegex(softscope.OptionError, "sequence.right_offset"):
            softscope.Sequence(self.clip, sequence_right_offset="none")

    def test_the_loop_may_be_left_and_continued(self):
        reconstructor = self.reconstructor("left")
        sequence = softscope.Sequence(self.clip)
        for report in reconstructor.process(sequence):
            if report.frame == 1:
                break
        self.assertEqual(next(sequence).index, 2)
        image = self.frames[2]
        report = reconstructor.process(image.left, image.right, time_s=image.time_s)
        self.assertEqual(report.frame, 2)
        rest = reconstructor.process(sequence)
        self.assertEqual([report.frame for report in rest], [3, 4, 5])
        self.assertEqual(list(rest), [], "each frame is read once")
        run = reconstructor.finish()
        self.assertEqual(run.frames, list(range(6)))
        self.assertTrue(filecmp.cmp(f"{run.folder}/model.ply", f"{self.made.folder}/model.ply",
                                    False))

    def test_a_run_may_end_early(self):
        reconstructor = self.reconstructor("early")
        reports = reconstructor.process(softscope.Sequence(self.clip))
        self.assertIs(iter(reports), reports)
        self.assertTrue(next(reports).fused)
        del reports  # the sequence, too
        self.assertEqual(reconstructor.finish().frames, [0])

    def test_reports_keep_their_reconstructor_and_sequence(self):
        reports = softscope.Reconstructor(self.calibration).process(softscope.Sequence(self.clip))
        self.assertEqual([report.frame for report in reports], list(range(6)))

    def test_other_threads_run_meanwhile(self):
        counted = []
        done = threading.Event()

        def count():
            while not done.wait(0.001):
                counted.append(1)
        thread = threading.Thread(target=count)
        thread.start()
        list(softscope.Reconstructor(self.calibration).process(softscope.Sequence(self.clip)))
        done.set()
        thread.join()
        self.assertGreater(len(counted), 20)  # of some hundred

    def test_other_sequences_are_refused(self):
        small = str(self.root / "small")
        softscope.simulate(small, frames=2, width_px=64, height_px=48)
        reconstructor = softscope.Reconstructor(self.calibration)
        with self.assertRaisesRegex(softscope.InputError, "64 x 48 px, but .* 240 x 180"):
            next(reconstructor.process(softscope.Sequence(small)))
        next(reconstructor.process(softscope.Sequence(self.clip)))
        with self.assertRaisesRegex(softscope.OptionError, "frame 0 comes after frame 0"):
            next(reconstructor.process(softscope.Sequence(self.clip)))
        with self.assertRaises(TypeError):
            reconstructor.process(self.clip)


class Reconstructs(Clip):
    def test_every_frame_is_fused(self):
        self.assertEqual([report.status for report in self.reports], ["started"] + 5 * ["fused"])
        self.assertEqual([report.frame for report in self.reports], list(range(6)))
        for report in self.reports:
            self.assertTrue(0.5 < report.confidence <= 1, report.confidence)
            self.assertEqual((report.map, report.joined_map), (0, None))
        self.assertGreater(self.reports[-1].points, 1000)

    def test_the_result_has_the_commands_bytes(self):
        out = str(self.root / "command")
        subprocess.run([PROGRAM, "reconstruct", self.clip, "--out", out, "--save-every", "1",
                        "--quiet"], check=True, stdout=subprocess.DEVNULL)
        for name in ["model.ply", "trajectory.txt", "models/000003.ply", "nodes/000003.csv"]:
            self.assertTrue(filecmp.cmp(f"{self.made.folder}/{name}", f"{out}/{name}", False), name)

    def test_the_model_is_near_the_truth(self):
        evaluation = softscope.evaluate(self.made, self.clip)
        # The command gives the same number; half a millimetre is 1 % of the distance.
        self.assertLess(evaluation.surface.observed.p95_mm, 0.5)
        self.assertEqual(evaluation.metric("surface.observed.p95_mm"),
                         evaluation.surface.observed.p95_mm)
        self.assertGreater(evaluation.surface.observed.count, 1000)

    def test_a_run_has_poses_and_models(self):
        run = softscope.Run(self.made.folder)
        self.assertEqual(run.frames, list(range(6)))
        self.assertEqual(run.poses.shape, (6, 4, 4))
        np.testing.assert_array_equal(run.poses[0], np.eye(4))
        np.testing.assert_allclose(run.poses[3], self.reports[3].world_from_left, atol=1e-6)
        self.assertEqual(run.saved_models, list(range(6)))
        model = run.model(3)
        self.assertEqual(len(model), self.reports[3].points)
        self.assertEqual(model.points_mm.shape, (len(model), 3))
        np.testing.assert_allclose(np.linalg.norm(model.normals, axis=1), 1, atol=1e-5)

    def test_a_comparison_gives_both_directions(self):
        found = softscope.compare(f"{self.clip}/groundtruth/mesh/000005.ply",
                                  f"{self.made.folder}/model.ply")
        self.assertLess(found.accuracy.p95_mm, 2)
        self.assertGreater(found.completeness.p95_mm, found.accuracy.p95_mm)

    def test_depth_has_the_commands_values(self):
        pair = self.frames[2].left, self.frames[2].right
        depth = softscope.DepthEstimator(self.calibration).measure(*pair)
        out = self.root / "depth"
        subprocess.run([PROGRAM, "depth", self.clip, "--frames", "2:3", "--write", "depth", "--out",
                        str(out), "--quiet"], check=True, stdout=subprocess.DEVNULL)
        bytes_of_file = next(out.glob("*depth.pfm")).read_bytes()
        values = np.frombuffer(bytes_of_file[-4 * 180 * 240:], "<f4").reshape(180, 240)[::-1]
        measured = np.isfinite(depth.depth_mm)
        self.assertGreater(measured.mean(), 0.5)
        np.testing.assert_array_equal(depth.depth_mm[measured], values[measured])
        self.assertEqual(depth.normals.shape, (180, 240, 3))
        self.assertEqual(depth.left.shape, (180, 240, 3))
        self.assertTrue((depth.sigma_mm[measured] > 0).all())

    def test_a_page_and_a_figure_have_the_commands_bytes(self):
        softscope.evaluate(self.made, self.clip, out=str(self.root / "evaluation"))
        for made_by in ("module", "command"):
            (self.root / made_by).mkdir(exist_ok=True)
        cases, page, figure = [str(self.root / "evaluation")], "page.html", "figure.svg"
        self.assertEqual(softscope.report(cases, str(self.root / "module" / page)), [])
        softscope.figure([str(self.root / "module" / figure)], run=self.made.folder,
                         reference=self.clip)
        for words in (["report", *cases, "--out", str(self.root / "command" / page)],
                      ["figure", self.made.folder, "--reference", self.clip, "--out",
                       str(self.root / "command" / figure)]):
            subprocess.run([PROGRAM, *words, "--quiet"], check=True, stdout=subprocess.DEVNULL)
        for name in (page, figure, "figure.json"):
            self.assertTrue(filecmp.cmp(self.root / "module" / name, self.root / "command" / name,
                                        False), name)

    def test_settings_change_the_result(self):
        self.assertIn("stereo.method", softscope.settings())
        reconstructor = softscope.Reconstructor(self.calibration, {"stereo.method": "sgbm"})
        report = reconstructor.process(self.frames[0].left, self.frames[0].right)
        self.assertNotEqual(report.points, self.reports[0].points)

    def test_settings_are_keywords_too(self):
        self.assertIn("push.amplitude_mm", softscope.settings("simulate"))
        pair = self.frames[0].left, self.frames[0].right
        points = [softscope.Reconstructor(self.calibration, **given).process(*pair).points
                  for given in ({"settings": {"stereo.method": "sgbm"}}, {"stereo_method": "sgbm"})]
        self.assertEqual(points[0], points[1])
        self.assertNotEqual(points[0], self.reports[0].points)
        depth = softscope.DepthEstimator(self.calibration, stereo_method="sgbm").measure(*pair)
        self.assertEqual(depth.method, "sgbm")
        made = softscope.simulate(str(self.root / "two"), frames=2, width_px=64, height_px=48)
        self.assertEqual(made.frames, 2)

    def test_a_network_is_a_setting(self):
        pair = self.frames[0].left, self.frames[0].right
        depth = softscope.DepthEstimator(self.calibration, stereo_method="onnx",
                                         stereo_model=str(NETWORK)).measure(*pair)
        self.assertEqual(depth.method, "onnx")
        with self.assertRaisesRegex(softscope.InputError, "isn't an ONNX model"):
            softscope.DepthEstimator(self.calibration, stereo_method="onnx", stereo_model=__file__)

    def test_a_grey_image_stands_for_three_equal_channels(self):
        grey = [np.ascontiguousarray(image[:, :, 1])
                for image in (self.frames[0].left, self.frames[0].right)]
        threefold = [np.repeat(image[:, :, None], 3, axis=2) for image in grey]
        reports = [softscope.Reconstructor(self.calibration).process(*pair)
                   for pair in (grey, threefold)]
        self.assertEqual(reports[0].points, reports[1].points)
        self.assertGreater(reports[0].points, 1000)


class Shares(Clip):
    def test_arrays_are_views_that_keep_their_owner(self):
        frame = softscope.Sequence(self.clip).__next__()
        left = frame.left
        self.assertEqual((left.shape, left.dtype), ((180, 240, 3), np.uint8))
        self.assertFalse(left.flags.owndata)
        self.assertIs(left.base, frame)
        self.assertIsNone(frame.mask)
        points = self.made.model().points_mm
        self.assertFalse(points.flags.owndata)
        self.assertTrue(np.isfinite(points).all())


class Refuses(Clip):
    def test_errors_have_a_type_and_a_text(self):
        with self.assertRaisesRegex(softscope.InputError, "no such folder"):
            softscope.Run(str(self.root / "none"))
        with self.assertRaisesRegex(softscope.OptionError, "stereo.method"):
            softscope.Reconstructor(self.calibration, {"stereo.methd": "sgbm"})
        with self.assertRaisesRegex(softscope.OptionError, "stereo.method"):
            softscope.Reconstructor(self.calibration, stereo_methd="sgbm")
        with self.assertRaisesRegex(softscope.OptionError, "once"):
            softscope.Reconstructor(self.calibration, {"stereo.method": "sgbm"},
                                    stereo_method="sgbm")
        with self.assertRaisesRegex(softscope.OptionError, "rigid"):
            softscope.evaluate(self.made, self.clip, align="somehow")
        with self.assertRaises(softscope.OptionError):
            softscope.Reconstructor(self.calibration).finish()
        with self.assertRaisesRegex(softscope.OptionError, "^`kind=` is pie, but must be four"):
            softscope.figure([str(self.root / "a.png")], kind="pie")
        with self.assertRaisesRegex(softscope.OptionError, "give `overwrite=`"):
            softscope.simulate(self.made.folder, {"frames": 1})
        self.assertTrue(issubclass(softscope.InputError, softscope.Error))
        self.assertTrue(issubclass(softscope.Error, RuntimeError))

    def test_images_of_another_shape_or_type_are_refused(self):
        reconstructor = softscope.Reconstructor(self.calibration)
        left = self.frames[0].left
        with self.assertRaisesRegex(softscope.InputError, "dimensions"):
            reconstructor.process(left.reshape(-1), left)
        with self.assertRaisesRegex(softscope.InputError, "channels"):
            reconstructor.process(np.zeros((180, 240, 4), np.uint8), left)
        with self.assertRaisesRegex(softscope.InputError, "empty"):
            reconstructor.process(np.zeros((0, 0, 3), np.uint8), left)
        with self.assertRaises(softscope.InputError):
            reconstructor.process(left[:90], left[:90])
        with self.assertRaises(softscope.InputError):
            reconstructor.process(left, left, mask=np.zeros((90, 240), np.uint8))
        with self.assertRaises(TypeError):
            reconstructor.process(left.astype(float), left)

    def test_progress_counts_and_stops(self):
        seen = []
        with self.assertRaisesRegex(softscope.Error, "stopped"):
            softscope.evaluate(self.made, self.clip, views=False,
                               progress=lambda done, total: seen.append((done, total)) or done < 2)
        self.assertEqual(seen[:3], [(0, 6), (1, 6), (2, 6)])
        made = softscope.simulate(str(self.root / "short"), {"frames": 5}, width_px=64,
                                  height_px=48, progress=lambda done, total: done < 2)
        self.assertEqual(made.frames, 2)

    def test_an_exception_of_the_callback_comes_through(self):
        def fail(done, total):
            raise KeyError("mine")
        with self.assertRaisesRegex(KeyError, "mine"):
            softscope.evaluate(self.made, self.clip, views=False, progress=fail)


if __name__ == "__main__":
    unittest.main()
