"""The report of the closed loops as Markdown."""

from benchmark_lib.cases import LOOP_PRESET
from benchmark_lib.report import loop_sums, loop_table

from .bound import upper_bound

PAGE = """# Closed loops

The demo's robot picks the best pose, again and again, until the bin is empty or nothing in it is reliable. This page is written by

    {command}

which keeps what is done in `{folder}` and goes on where it was stopped. {count} parts in the bin, sensor {preset}, seeds {seeds}:
`roslaunch ppf_bin_picking demo.launch part:=PART count:={count} seed:=SEED preset:={preset}`. Commit {commit}; {machine}.

Wrong picks: {wrong} of {picks}, {share:.2%}; with a confidence of 95 % less than {bound:.2%} (one-sided, Clopper and Pearson).
Of the {parts} parts {left:.1%} were left in the bin. A blocked pick had the right pose, of a part that another one lay on; it counts as no
wrong one, and the part is left.

{table}"""


def write_page(facts, loops):
    """loops: by part what became of each loop."""
    everything = [loop for some in loops.values() for loop in some]
    sums = loop_sums(everything)
    picks = sums["picked"] + sums["wrong"]
    return PAGE.format(
        **{**facts, "seeds": ", ".join(map(str, facts["seeds"]))},
        preset=LOOP_PRESET,
        wrong=sums["wrong"],
        picks=picks,
        share=sums["wrong"] / max(1, picks),
        bound=upper_bound(sums["wrong"], picks),
        parts=len(everything) * facts["count"],
        left=sums["left"] / (len(everything) * facts["count"]),
        table=loop_table(loops),
    )
