"""The tree keeps the rules of docs/architecture.md, and a made-up breach of each is found."""
import unittest
from pathlib import Path

import include_rules

ROOT = Path(__file__).resolve().parents[2]

# What must be found, in made-up lines: file, line, a word of the complaint.
BREACHES = [
    ("src/core/camera.h", '#include "io/settings/settings.h"', "src/core may include nothing else"),
    ("src/stereo/matching/elas_matcher.cpp", '#include "deform/graph/warp.h"', "src/stereo may include core"),
    ("src/io/files/folder.cpp", '#  include "stereo/refinement/plane.h"', "src/io may include core"),
    ("eval/distance/triangle_tree.cpp", '#include "io/files/folder.h"', "eval may include core"),
    ("vtk_views/drawing/canvas.cpp", '#include "eval/distance/triangle_tree.h"', "vtk_views may include core"),
    ("cuda/device/device_info.cu", '#include "pipeline/backends.h"', "cuda may include"),
    ("src/core/image.cpp", '#include "image.h"', "not written from the root"),
    ("apps/depth.cpp", '#include "log.h"', "not written from the root"),
    ("src/core/image.cpp", '#include "../io/folder.h"', "src/core may include nothing else"),
    ("eval/distance/triangle_tree.cpp", "#include <vtkPolyData.h>", "its home in vtk_views"),
    ("src/stereo/refinement/plane.cpp", "#include <opencv2/imgcodecs.hpp>", "its home in src/io"),
    ("src/deform/graph/warp.cpp", "#include <opencv2/core.hpp>", "its home in src/io, src/stereo"),
    ("src/io/files/folder.cpp", "#include <opencv2/opencv.hpp>", "its home in no file"),
    ("src/core/image.cpp", "#include <tbb/parallel_for.h>", "its home in src/core/parallel.cpp"),
    ("apps/depth.cpp", "#include <CLI/CLI.hpp>", "its home in apps/command_line.cpp"),
    ("src/io/settings/settings.cpp", "#include <spdlog/spdlog.h>", "its home in apps"),
    ("toolkit/run/run_folder.cpp", '#include "apps/command.h"', "toolkit may include calibrate, core"),
    ("tests/toolkit/report_test.cpp", '#include "apps/command.h"', "tests/toolkit may include"),
    ("toolkit/report/report_case.cpp", "#include <spdlog/spdlog.h>", "its home in apps"),
    ("toolkit/viewer/view_movie.cpp", "#include <iostream>", "its home in apps"),
    ("toolkit/depth/depth_outputs.cpp", "#include <unistd.h>", "its home in src/io, apps"),
    ("vtk_views/drawing/canvas.cpp", '#include "toolkit/progress.h"', "vtk_views may include core"),
    ("vtk_views/plots/series_plot.cpp", "#include <vtkPolyData.h>", "its home in vtk_views/files"),
    ("src/io/files/folder.cpp", '#include "io/sequences/sequence_reader.h"',
     "src/io/files may include text"),
    ("src/stereo/kernels/kernel_sets.cpp", '#include "stereo/matching/elas_matcher.h"',
     "src/stereo/kernels may include options"),
    ("eval/simulation/sequence/simulator.cpp", '#include "eval/distance/triangle_tree.h"',
     "eval/simulation/sequence may include camera"),
    ("vtk_views/volumes/volume.cpp", '#include "vtk_views/scenes/scene.h"',
     "vtk_views/volumes may include files"),
    ("vtk_views/drawing/canvas.h", '#include "vtk_views/plots/plot_axes.h"',
     "vtk_views/drawing may include no other room"),
    ("src/pipeline/backends.cpp", '#include "toolkit/progress.h"', "src/pipeline may include"),
    ("include/softscope/run.h", '#include "io/files/folder.h"', "include may include core"),
    ("include/softscope/run.h", "#include <nlohmann/json.hpp>", "its home in src/io, toolkit"),
    ("include/softscope/run.h", "#include <opencv2/core.hpp>", "its home in src/io, src/stereo"),
    ("python/bindings.cpp", '#include "toolkit/run/run_reader.h"', "python may include softscope"),
    ("toolkit/face/run.cpp", "#include <pybind11/numpy.h>", "its home in python"),
    ("src/stereo/refinement/plane.cpp", "#include <curl/curl.h>", "no home"),
    ("src/stereo/matching/row_prior.cpp", "#include <boost/polygon/voronoi.hpp>", "no home"),
    ("src/stereo/refinement/plane.cpp", "#include <math.h>", "no home"),
]

# What must be allowed.
FINE = [
    ("src/core/camera.h", "#include <Eigen/Core>"),
    ("src/core/camera.h", "#include <vector>"),
    ("src/core/camera.h", '#include "core/hd.h"'),
    ("src/io/images/image_reader.cpp", "#include <opencv2/imgcodecs.hpp>"),
    ("src/core/parallel.cpp", "#include <tbb/parallel_for.h>"),
    ("src/pipeline/backends.h", '#include "cuda/device/device_info.h"'),
    ("apps/depth.cpp", '#include "vtk_views/drawing/canvas.h"'),
    ("python/bindings.cpp", '#include "softscope/softscope.h"'),
    ("toolkit/face/run.cpp", '#include "softscope/run.h"'),
    ("toolkit/run/run_record.cpp", '#include "toolkit/record/machine.h"'),
    ("toolkit/evaluation/evaluate_view.cpp", '#include "eval/image_similarity.h"'),
    ("vtk_views/viewer/view_scene.cpp", '#include "vtk_views/scenes/scene.h"'),
    ("vtk_views/scenes/scene.cpp", '#include "vtk_views/scenes/view_plane.h"'),
    ("tests/io/image_reader_test.cpp", "#include <opencv2/imgcodecs.hpp>"),
    ("tests/deform/warp_test.cpp", '#include "scenes.h"'),
    ("tests/toolkit/report_test.cpp", '#include "toolkit/report/write_report.h"'),
    ("vtk_views/drawing/canvas.cpp", '// #include "eval/distance/triangle_tree.h"'),
]


class IncludeRules(unittest.TestCase):
    def setUp(self):
        text = (ROOT / "docs/architecture.md").read_text(encoding="utf-8")
        self.rules = include_rules.Rules(text)

    def test_the_tree_keeps_them(self):
        found = include_rules.violations(ROOT)
        if found:
            self.fail("\n" + "\n".join(found))

    def test_every_folder_has_a_row(self):
        self.assertEqual(include_rules.folders_without_row(ROOT), [])

    def test_every_source_of_a_library_with_rooms_lies_in_one(self):
        self.assertEqual(include_rules.sources_without_room(ROOT), [])

    def test_rooms_exist(self):
        self.assertEqual([room for room in self.rules.rooms if not (ROOT / room).is_dir()], [])

    def test_files_named_as_homes_exist(self):
        homes = [place for places in self.rules.homes.values() for place in places or []]
        missing = [place for place in homes + self.rules.free if not (ROOT / place).exists()]
        self.assertEqual(missing, [])

    def test_each_breach_is_found(self):
        for path, line, complaint in BREACHES:
            with self.subTest(path=path, line=line):
                self.assertIn(complaint, self.rules.check(path, line) or "nothing found")

    def test_what_is_allowed_passes(self):
        for path, line in FINE:
            with self.subTest(path=path, line=line):
                self.assertIsNone(self.rules.check(path, line))

    def test_a_lost_table_is_no_licence(self):
        with self.assertRaises(ValueError):
            include_rules.Rules("# Architecture\nwithout tables\n")


if __name__ == "__main__":
    unittest.main()
