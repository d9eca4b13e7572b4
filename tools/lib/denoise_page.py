"""The part of tools/denoise_table that draws: a page of pictures, each mesh as it is and with --denoise.

The page is build/denoise_page/index.html, with a picture for each noisy mesh of a folder of pairs
(denoise_pairs.py), whether or not it has an original.
"""

import glob
import html
import os

from denoise_pairs import chosen, figures_of, mesh_in
from tables import ROOT, smooth

TARGET = os.path.join(ROOT, "build", "denoise_page")
STYLE = ("body { font: 16px sans-serif; display: grid; gap: 1em; "
         "grid-template-columns: repeat(auto-fill, minmax(30em, 1fr)); } "
         "figure { margin: 0; } img { width: 100%; }")


def entry(folder):
    """A picture of the mesh in `folder`, and a line about it."""
    name = os.path.basename(folder)
    noisy, original = mesh_in(folder, "noisy"), mesh_in(folder, "original")
    result, picture = (os.path.join(TARGET, name + ending) for ending in (".ply", ".png"))
    report = smooth(noisy, result, "--denoise", "--picture", picture)
    line = f"{name}: {chosen(report)}"
    if original:
        (before, _), (after, _) = figures_of(noisy, original), figures_of(result, original)
        line += f"; Ea {before:.1f} before, {after:.2f} afterwards"
    os.remove(result)
    return (f'<figure><img src="{html.escape(name)}.png" alt=""><figcaption>{html.escape(line)}'
            "</figcaption></figure>\n")


def show_page(folder):
    os.makedirs(TARGET, exist_ok=True)
    folders = [path for path in sorted(glob.glob(os.path.join(folder, "*"))) if mesh_in(path, "noisy")]
    page = os.path.join(TARGET, "index.html")
    with open(page, "w", encoding="utf-8") as file:
        file.write('<!doctype html><html lang="en"><meta charset="utf-8">'
                   f"<title>Before and after --denoise</title><style>{STYLE}</style>\n")
        file.writelines(entry(path) for path in folders)
    print(page)
