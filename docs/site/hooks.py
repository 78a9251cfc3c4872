"""MkDocs calls this at the end: the index of the search as a script, since a page that is opened from disk loads no JSON."""

import pathlib


def on_post_build(config):
    folder = pathlib.Path(config["site_dir"]) / "search"
    index = (folder / "search_index.json").read_text(encoding="utf-8")
    (folder / "index.js").write_text(f"const index = {index};\n", encoding="utf-8")
