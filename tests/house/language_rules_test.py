"""Comments use the field's terms: no persons, no questions, no idioms that have a plain word."""
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("apps", "cuda", "eval", "packaging", "src", "toolkit", "vtk_views")
SOURCES = {".h", ".cpp", ".cu", ".cuh"}

# An idiom, and what to write in its place. docs/glossary.md has the field's terms.
IDIOMS = {
    r"\b(?:nobody|somebody|everybody|no one)\b": "the passive: `is not read`",
    r"\bwho\b": "the noun: `the caller`, `the user`",
    r"\b(?:you|your|we)\b": "the third person: `the user`, `this function`",
    r"\b(?:is|are|was|were|be) heard\b|\bhears\b": "`counts`, `is used`",
    r"\bvouch": "`predicted sigma`, `valid`",
    r"\bsure(?:r|st)\b": "`smaller predicted sigma`",
    r"\b(?:wants?|wanted by)\b": "`requires`, `target`",
    r"\b(?:believes?|remembers?|forgets?)\b": "`estimates`, `stores`, `drops`",
    r"\banew\b|\blest\b": "`again`, `so that … not`",
    r"\bso[- ]man(?:yth|ieth)\b": "`every n-th`",
    r"\bwhat (?:is|was) left\b": "`the remaining …`",
    r"\b(?:one|two|three|four|times|values?|numbers?|bytes?|threads?|lines?) an? "
    r"(?:point|pixel|frame|core|GPU|node|row|column|line|match|edge|case|cell|camera)\b":
        "`per`: `one per point`",
    r"\?(?:\s|$)": "a statement: `whether …`",
}
COMMENT = re.compile(r'"(?:\\.|[^"\\\n])*"|R"(\w*)\(.*?\)\1"|//(?P<text>[^\n]*)', re.DOTALL)


def idioms_in(source):
    """Line, found words and replacement per idiom in the comments of C++ text."""
    found = []
    for comment in COMMENT.finditer(source):
        for idiom, term in IDIOMS.items():
            hit = re.search(idiom, comment["text"] or "", re.IGNORECASE)
            if hit:
                line = source.count("\n", 0, comment.start()) + 1
                found.append((line, hit[0].strip(), term))
    return found


class LanguageRules(unittest.TestCase):
    def test_comments_use_the_terms_of_the_field(self):
        paths = [path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*"))
                 if path.suffix in SOURCES]
        self.assertGreater(len(paths), 500)
        found = {path.relative_to(ROOT).as_posix(): idioms_in(path.read_text(encoding="utf-8"))
                 for path in paths}
        wrong = [f"{name}:{line}: `{words}`; write {term}"
                 for name, idioms in found.items() for line, words, term in idioms]
        if wrong:
            self.fail("these comments use idioms:\n  " + "\n  ".join(wrong))

    def test_made_up_breaches_are_found(self):
        for comment in ("depths less sure than this, which nobody reads",
                        "a measurement that is heard",
                        "what you pass",
                        "the surer of both",
                        "where the surface wants a point to be",
                        "every so-manyth model",
                        "one a pixel, two bytes a point",
                        "do rows really correspond?",
                        "removes what is left"):
            self.assertTrue(idioms_in(f"int a = 0;  // {comment}\n"), comment)

    def test_plain_comments_and_strings_pass(self):
        for source in ("// One per pixel; the remaining rows are ignored.\n",
                       'say("who wants it?");  // a text that the user reads\n',
                       "const bool right = a ? b : c;  // the larger one\n"):
            self.assertEqual(idioms_in(source), [], source)


if __name__ == "__main__":
    unittest.main()
