"""Tests the palette that the pages, the Python module and the examples share."""

import json
import pathlib

import support
from support import Case, isojam

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PALETTE = json.loads((SOURCE / "tasks/extras/page/palette.json").read_text())


class Palette(Case):
    def test_the_module_has_the_colours_of_the_pages(self):
        self.assertEqual(isojam.palette.colours, PALETTE["colours"])
        styles = isojam.palette.styles(PALETTE["solids"])
        for name, solid in PALETTE["solids"].items():
            self.assertEqual(styles[name], {"color": PALETTE["colours"][solid["colour"]], "marker": solid["marker"]})
        self.assertEqual(len(isojam.palette.series), len(set(isojam.palette.series)))

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


if __name__ == "__main__":
    support.main()
