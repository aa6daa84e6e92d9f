# SPDX-License-Identifier: GPL-2.0-only
"""Tables of the plane channel: every run of a peer against each of our four series."""

import channel
import common
import comparison
from peers_channel import FAMILIES

TARGET = 100  # at least so much less run time at equal error, or less error at equal run time
COLUMNS = {"code": "code", "variant": "settings", "n": "2H/d", "N": "N", "tol": "tol",
           "dt nu/H^2": "nu dt/H^2", "steps": "steps", "time": "nu t/H^2", "seconds": "seconds",
           "l2": "L2", "l2 nominal wall": "L2, nominal wall", "wall shift/d": "wall shift/d"}


def ratios(rows):
    """With the fitted wall, and with the nominal one."""
    nominal = [{**row, "l2": row["l2 nominal wall"]} for row in rows if row["code"] != "aleisph"]
    ours = [row for row in rows if row["code"] == "aleisph"]
    out = list(comparison.ratios(rows, FAMILIES))
    for row, other in zip(out, comparison.ratios(ours + nominal, FAMILIES)):
        row.update({"l2 nominal wall": other["l2"],
                    "time ratio nominal wall": other["time shown"],
                    "error ratio nominal wall": other["error shown"]})
    return out


def summary(compared):
    """One row per peer and time: for each of our series the ratios where it is least ahead."""
    for peer in dict.fromkeys(row["peer"] for row in compared):
        for time in channel.TIMES:
            yield {"peer": peer, "nu t/H^2": time,
                   **{family: comparison.cell(comparison.least(compared, peer, time, family))
                      for family in FAMILIES}}


def verdicts(compared):
    for peer in dict.fromkeys(row["peer"] for row in compared):
        for time in channel.TIMES:
            for family in FAMILIES:
                row = comparison.least(compared, peer, time, family)
                for key, quantity in (("time ratio", "time-ratio"), ("error ratio", "error-ratio")):
                    value = row[key] if row[key] is not None else "none"
                    yield common.result_line(
                        case=f"{peer}/{family}".replace(" ", "-"), quantity=quantity, time=time,
                        value=value, reference=TARGET, l2=row["l2"], seconds=row["seconds"])


def write(table, compared, out):
    """Writes the tables; returns them as Markdown."""
    common.write_csv(out / "channel.csv", table)
    common.write_csv(out / "channel-ratios.csv", compared)
    least_ahead = list(summary(compared))
    common.write_csv(out / "channel-summary.csv", least_ahead)
    return ("Its run time over ours at equal L2 / its L2 over ours at equal run time, at the "
            "run (n) of the\npeer where we are least ahead:\n\n"
            + common.markdown(least_ahead, {key: key for key in least_ahead[0]})
            + "\nAll runs:\n\n" + common.markdown(table, COLUMNS))
