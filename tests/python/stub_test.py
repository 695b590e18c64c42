"""softscope.pyi, which is made at each build: what it says is what the module has."""
import ast
import unittest
from pathlib import Path

import softscope

STUB = Path(softscope.__file__).parent / "softscope.pyi"


class Stub(unittest.TestCase):
    def setUp(self):
        self.tree = ast.parse(STUB.read_text(encoding="utf-8"))
        self.classes = {node.name: node for node in self.tree.body
                        if isinstance(node, ast.ClassDef)}
        self.functions = {node.name: node for node in self.tree.body
                          if isinstance(node, ast.FunctionDef)}

    def test_every_public_name_is_there(self):
        public = {name for name in vars(softscope) if not name.startswith("_")}
        self.assertEqual(public, set(self.classes) | set(self.functions))
        for name, node in self.classes.items():
            cls = getattr(softscope, name)
            if issubclass(cls, Exception):
                continue
            members = {member for member in vars(cls) if not member.startswith("_")}
            self.assertEqual(members - {part.name for part in node.body
                                        if isinstance(part, ast.FunctionDef)}, set(), name)

    def test_settings_are_keywords_with_a_type(self):
        methods = {part.name: part for part in self.classes["Reconstructor"].body
                   if isinstance(part, ast.FunctionDef)}
        keywords = {arg.arg: arg.annotation.id for arg in methods["__init__"].args.kwonlyargs}
        self.assertEqual(set(keywords), {key.replace(".", "_") for key in softscope.settings()})
        self.assertEqual(keywords["stereo_method"], "str")
        self.assertEqual(keywords["stereo_disparity_max_px"], "int")
        simulate = {arg.arg for arg in self.functions["simulate"].args.kwonlyargs}
        self.assertLess({"frames", "push_amplitude_mm"}, simulate)

    def test_every_result_has_a_type(self):
        for name, node in self.classes.items():
            for part in node.body:
                if isinstance(part, ast.FunctionDef):
                    self.assertNotIn("Any", ast.unparse(part.returns), f"{name}.{part.name}")
        self.assertIn("NDArray[numpy.uint8]", ast.unparse(self.classes["Frame"]))


if __name__ == "__main__":
    unittest.main()
