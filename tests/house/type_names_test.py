"""A type's name is unique in the program, and made-up doubles are found.

Two types of one name in one program are undefined behaviour: the linker keeps one of two
functions of the same name, a destructor for instance, and calls it for both types.
"""
import unittest
from pathlib import Path

import type_names

ROOT = Path(__file__).resolve().parents[2]

# What each text defines at namespace scope.
TEXTS = [
    ("namespace softscope {\nstruct Camera {\n  struct Inner {};\n};\n}", ["softscope::Camera"]),
    ("namespace a::b { enum class Kind : int { kOne }; }", ["a::b::Kind"]),
    ("namespace a { namespace { class Walk final : public Base<int> {}; } }", ["a::Walk"]),
    ("inline namespace v1 { template <class T = std::map<int, int>> struct Box {}; }", ["v1::Box"]),
    ("template <class T> struct [[nodiscard]] alignas(32) Row : Base<Row<T>> {};", ["Row"]),
    ('extern "C" {\nunion Word { int i; };\n}', ["Word"]),
    ("struct Ahead; struct Later* make(); struct Pair pair = {1, 2};", []),
    ("namespace std { template <> struct hash<a::B> : Base { }; }", []),
    ("enum { kLoose };  struct { int a; } unnamed;", []),
    ("void f() { struct Local {}; }  struct Known g() { return {}; }", []),
    ("// struct Comment {};\n/* struct Comment {}; */ const char* t = R\"x(struct Text {};)x\";", []),
    ("#define TYPE \\\n  struct Macro {};\nconst char brace = '{'; struct After {};", ["After"]),
    ("constexpr int kMany = 1'000'000; struct After {};", ["After"]),
]


def found_in(files):
    return type_names.doubled([definition for path, text in files
                               for definition in type_names.definitions(path, text)])


SHARED = "namespace softscope { struct Cell {}; }"
LOCAL = "namespace softscope { namespace { struct Cell {}; } }"


class TypeNames(unittest.TestCase):
    def test_every_name_is_unique_in_the_program(self):
        found = type_names.doubled(type_names.definitions_of_tree(ROOT))
        if found:
            self.fail("these types share a name; give one of them another:\n  "
                      + "\n  ".join(found))

    def test_the_types_of_the_tree_are_seen(self):
        names = {definition.visible_as for definition in type_names.definitions_of_tree(ROOT)}
        self.assertGreater(len(names), 500)
        self.assertIn(("softscope", "PointModel"), names)
        self.assertIn(("softscope", "StereoMatcher"), names)

    def test_types_at_namespace_scope_are_found(self):
        for text, expected in TEXTS:
            with self.subTest(text=text):
                found = type_names.definitions("src/core/made.h", text)
                self.assertEqual(["::".join(each.visible_as) for each in found], expected)

    def test_a_definition_knows_its_line(self):
        found = type_names.definitions("src/core/made.h", '/* one\ntwo */\n\nstruct Third {};')
        self.assertEqual([each.line for each in found], [4])

    def test_a_name_in_two_files_of_the_program_is_found(self):
        for one, other in [("src/deform/a.h", "src/fusion/b.h"), ("src/io/a.cpp", "apps/b.cpp"),
                           ("eval/a.h", "tests/eval/b.cpp"), ("tests/eval/a.h", "tests/eval/b.cpp"),
                           ("tests/support/a.h", "tests/mesh/b.h")]:
            with self.subTest(one=one, other=other):
                found = found_in([(one, SHARED), (other, SHARED)])
                self.assertEqual(found, [f"{one}:1 and {other}:1: softscope::Cell"])

    def test_a_local_name_clashes_with_a_header_alone(self):
        self.assertTrue(found_in([("src/io/a.h", SHARED), ("apps/b.cpp", LOCAL)]))
        self.assertFalse(found_in([("src/io/a.cpp", SHARED), ("apps/b.cpp", LOCAL)]))
        self.assertFalse(found_in([("src/io/a.cpp", LOCAL), ("apps/b.cpp", LOCAL)]))

    def test_other_programs_and_other_namespaces_are_free(self):
        self.assertFalse(found_in([("tests/eval/a.h", SHARED), ("tests/mesh/b.h", SHARED)]))
        elsewhere = "namespace softscope::test { struct Cell {}; }"
        self.assertFalse(found_in([("src/io/a.h", SHARED), ("tests/io/b.h", elsewhere)]))
        self.assertFalse(found_in([("src/io/a.h", SHARED + SHARED)]))


if __name__ == "__main__":
    unittest.main()
