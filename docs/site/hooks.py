"""MkDocs calls this after it has written the site, to add what it leaves out."""

import pathlib
import shutil


def on_post_build(config):
    site = pathlib.Path(config["site_dir"])
    # A page that is opened from disk loads a script, but no JSON.
    index = (site / "search/search_index.json").read_text(encoding="utf-8")
    (site / "search/index.js").write_text(f"const index = {index};\n", encoding="utf-8")
    # MkDocs of Debian 13 links to the theme's style sheet in another package, and not to the fonts beside it.
    for folder in config["theme"].dirs:
        fonts = pathlib.Path(folder, "css/theme.css").resolve().parents[1] / "fonts"
        if fonts.is_dir():
            shutil.copytree(fonts, site / "fonts", dirs_exist_ok=True)
