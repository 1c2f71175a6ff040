"""What the site has beside the pages of this folder.

CONTRIBUTING.md and CHANGELOG.md of the repository's root become pages. The addresses of other sites that pages link to
are not visited; they are listed in external-links.txt, for a person to look through.
"""

import re
from html import escape
from pathlib import Path

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files

OUTSIDE = ("CONTRIBUTING.md", "CHANGELOG.md")


def on_files(files: Files, *, config: MkDocsConfig) -> Files:
    """The files of the site, with those from outside the folder."""
    root = Path(config.config_file_path).parent
    for name in OUTSIDE:
        files.append(File.generated(config, name.lower(), content=_moved((root / name).read_text(encoding="utf-8"))))
    return files


def _moved(text: str) -> str:
    """The page as it reads from this folder: links into it are shortened, those to other files are left as text."""
    names = {name: name.lower() for name in OUTSIDE}

    def link(match: re.Match[str]) -> str:
        label, target = match.groups()
        if re.match(r"[a-z]+:|#", target):
            return match[0]
        page = names.get(target, target.removeprefix("docs/") if target.startswith("docs/") else None)
        return label if page is None else f"[{label}]({page})"

    return re.sub(r"(?<!!)\[([^]\n]+)\]\(([^)\s]+)\)", link, text)


def on_page_markdown(markdown: str, **_: object) -> str:
    """The page with code in tables as HTML where it has bars, of which the site would show the backslashes."""

    def code(match: re.Match[str]) -> str:
        return f"<code>{escape(match[1]).replace(chr(92) + '|', '&#124;')}</code>"

    rows = (re.sub(r"`([^`]*\\\|[^`]*)`", code, row) if row.startswith("|") else row for row in markdown.split("\n"))
    return "\n".join(rows)


def on_post_build(*, config: MkDocsConfig) -> None:
    """Write the list of the links to other sites."""
    site = Path(config.site_dir)
    pages = {page.name: page.read_text(encoding="utf-8") for page in site.glob("*.html")}
    found = {
        (address, name) for name, text in pages.items() for address in re.findall(r'href="(https?://[^"]+)"', text)
    }
    lines = [f"{address}  {name}\n" for address, name in sorted(found)]
    (site / "external-links.txt").write_text("".join(lines), encoding="utf-8")
