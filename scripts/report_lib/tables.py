"""A table that becomes Markdown, HTML or CSV, and how its numbers are written."""
import csv
import dataclasses
import html
import io
import math


@dataclasses.dataclass
class Table:
    """name: of its .csv. rows: texts as they shall be read; data: the full figures, one object a row, for the .csv."""
    name: str
    head: list
    rows: list = dataclasses.field(default_factory=list)
    data: list = dataclasses.field(default_factory=list)

    def markdown(self):
        lines = ["| " + " | ".join(self.head) + " |", "|" + "---|" * len(self.head)]
        return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in self.rows]) + "\n"

    def html(self):
        def line(cells, tag):
            return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>"
        body = "\n".join(line(row, "td") for row in self.rows)
        return f"<table>\n<thead>{line(self.head, 'th')}</thead>\n<tbody>\n{body}\n</tbody></table>\n"

    def csv(self):
        text = io.StringIO()
        columns = list(self.data[0]) if self.data else self.head
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(columns)
        for entry in self.data:
            writer.writerow([entry.get(column, "") for column in columns])
        return text.getvalue()


def figure(value, digits=3):
    """Significant digits, without needless zeros; "-" for what has no value."""
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return "-"
    return f"{value:.{digits}g}" if abs(value) < 10 ** digits else f"{value:.0f}"


def percent(fraction, digits=2):
    return "-" if fraction is None else figure(100 * fraction, digits) + " %"


def signed_percents(fractions):
    """Of R, G, B."""
    return " ".join("-" if f is None else f"{100 * f:+.2f}" for f in fractions)
