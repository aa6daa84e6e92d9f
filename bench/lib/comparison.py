# SPDX-License-Identifier: GPL-2.0-only
"""Error against run time of one code over another: ratios, and where we are least ahead.

A row is a run at one time of comparison: code, variant, n, time, seconds, l2. A run that failed has
no l2 but 'failure'. The runs of one of our series form an envelope (common.py).
"""

import common


def compare(its_seconds, its_error, ours):
    """A run of a peer against the runs (seconds, error) of one of our series."""
    seconds, quicker = common.time_for_error(ours, its_error)
    error, better = common.error_at_time(ours, its_seconds)
    time_ratio = its_seconds / seconds if seconds else None
    error_ratio = its_error / error if error else None
    return {"time ratio": time_ratio, "time shown": shown(time_ratio, quicker),
            "error ratio": error_ratio, "error shown": shown(error_ratio, better)}


def shown(ratio, relation):
    """Ours is a bound ("<"): the ratio is at least this. None: we have no run to compare with."""
    if ratio is None:
        return "-"
    return (">" if relation == "<" else "") + f"{float(f'{ratio:.2g}'):g}"


def points(rows, variant, time):
    return [(r["seconds"], r["l2"]) for r in rows if r["code"] == "aleisph"
            and r["variant"] == variant and r["time"] == time and "l2" in r]


def peer_name(row):
    return f"{row['code']} {row['variant']}"


def ratios(rows, families):
    """Every run of a peer that has an error, at every time, against each of our series."""
    for row in rows:
        if row["code"] == "aleisph" or "l2" not in row:
            continue
        for family in families:
            ours = points(rows, family, row["time"])
            if ours:
                yield {"case": row["case"], "peer": peer_name(row), "ours": family,
                       **{key: row[key] for key in ("n", "time", "seconds", "l2")},
                       **compare(row["seconds"], row["l2"], ours)}


def least(compared, peer, time, family):
    """The run of this peer at this time where our series is least ahead; None: there is none."""
    rows = [r for r in compared
            if r["peer"] == peer and r["time"] == time and r["ours"] == family]
    return min(rows, key=lambda r: max(r["time ratio"] or 0, r["error ratio"] or 0), default=None)


def best(rows):
    """The run with the smallest error."""
    return min((r for r in rows if "l2" in r), key=lambda r: r["l2"], default=None)


def cell(row):
    return f"{row['time shown']} / {row['error shown']} (n={row['n']:g})" if row else "-"


def table(rows, compared, families):
    """Per time and series: its most accurate run, and the ratios where we are least ahead of it.

    families: {our series: column}; two series may not share a column.
    """
    case = rows[0]["case"] if rows else ""
    names = dict.fromkeys((row["time"], peer_name(row)) for row in rows)
    for time, name in sorted(names, key=lambda pair: pair[0]):
        mine = [r for r in rows if r["time"] == time and peer_name(r) == name]
        most = best(mine)
        line = {"case": case, "time": time, "series": name}
        if most:
            line.update({"n": most["n"], "least error": most["l2"], "seconds": most["seconds"]})
        else:
            line["failure"] = mine[-1]["failure"]
        if mine[0]["code"] != "aleisph":
            line.update({column: cell(least(compared, name, time, family))
                         for family, column in families.items()})
        yield line


def result_lines(rows, compared, families):
    """Machine-readable: the ratios where we are least ahead, for each peer, time and series."""
    for time, peer in dict.fromkeys((r["time"], r["peer"]) for r in compared):
        for family in families:
            row = least(compared, peer, time, family)
            if not row:
                continue
            for key in ("time", "error"):
                value = row[f"{key} ratio"]
                yield common.result_line(
                    case=row["case"], quantity="ratio", of=key, peer=peer.replace(" ", "-"),
                    ours=family.replace(" ", "-"), time=time,
                    value="none" if value is None else value,
                    bound=int(row[f"{key} shown"].startswith(">")), n=row["n"],
                    l2=row["l2"], seconds=row["seconds"])
    for row in rows:
        if "failure" in row:
            yield common.result_line(case=row["case"], quantity="failure", code=row["code"],
                                     settings=row["variant"].replace(" ", "-"), n=row["n"],
                                     time=row["time"],
                                     value=row["failure"].replace(" ", "-"))
