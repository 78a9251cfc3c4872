"""Tests the palette that the pages, the Python module and the examples share."""

import json
import pathlib
import re

import support
from support import Case, isojam

SOURCE = pathlib.Path(__file__).resolve().parents[2]
#: From the page of M. Okabe and K. Ito, Color Universal Design (2008).
OKABE_ITO = {"black": "#000000", "orange": "#e69f00", "sky": "#56b4e9", "green": "#009e73", "yellow": "#f0e442",
             "blue": "#0072b2", "vermilion": "#d55e00", "purple": "#cc79a7"}
PALETTE = json.loads((SOURCE / "tasks/extras/page/palette.json").read_text())


class Palette(Case):
    def test_the_module_has_the_colours_of_the_pages(self):
        self.assertEqual(isojam.palette.colours, PALETTE["colours"])
        styles = isojam.palette.styles(PALETTE["solids"])
        for name, solid in PALETTE["solids"].items():
            self.assertEqual(styles[name], {"color": PALETTE["colours"][solid["colour"]], "marker": solid["marker"]})
        self.assertEqual(len(isojam.palette.series), len(set(isojam.palette.series)))

    def test_the_platonic_solids_have_colours_of_okabe_and_ito(self):
        self.assertEqual({name: PALETTE["colours"][name] for name in OKABE_ITO}, OKABE_ITO)
        self.assertLessEqual({solid["colour"] for solid in PALETTE["solids"].values()}, set(OKABE_ITO))

    def test_solids_differ_in_colour_symbol_and_marker(self):
        everything = [*PALETTE["solids"].values(), *PALETTE["others"]]
        for key in ("colour", "symbol", "marker"):
            self.assertEqual(len({entry[key] for entry in everything}), len(everything), key)
        for names in (PALETTE["series"], PALETTE["dark"], [entry["colour"] for entry in everything]):
            self.assertLessEqual(set(names), set(PALETTE["colours"]))

    def test_other_solids_get_what_is_left(self):
        styles = isojam.palette.styles(["stone", "cube", "stone", "octahedron_0.5+cube_0.5"])
        self.assertEqual(list(styles), ["stone", "cube", "octahedron_0.5+cube_0.5"])
        self.assertEqual(len({style["color"] for style in styles.values()}), 3)
        first, second = (PALETTE["colours"][entry["colour"]] for entry in PALETTE["others"][:2])
        self.assertEqual([styles[name]["color"] for name in ("stone", "octahedron_0.5+cube_0.5")], [first, second])

    def test_colours_are_defined_once(self):
        hues = set(PALETTE["colours"].values()) - {"#000000"}
        found = []
        for path in [*SOURCE.glob("tasks/extras/**/*"), *SOURCE.glob("examples/**/*.py")]:
            if path.suffix in (".js", ".css", ".py", ".cpp"):
                found += [f"{path.name}: {text}" for text in re.findall(r"#[0-9a-f]{6}", path.read_text().lower())
                          if text in hues]
        self.assertEqual(found, [])


if __name__ == "__main__":
    support.main()
