"""How long a method needs to a wanted error, from its series of runs."""
import math

from report_lib.measure import can_tell, net, squared, squared_net
from report_lib.tables import Table, figure

# Figure of measure.py, name, limit. 1 % RMSE is Segovia's criterion (2006). Trimmed: without the 0.1 % of pixels that
# differ most, where single paths to a small bright lamp would decide.
WANTED = (("relmse", "relMSE 0.1", 0.1), ("relmse", "relMSE 0.01", 0.01), ("relmse", "relMSE 0.001", 0.001),
          ("relmse_trimmed", "trimmed 0.1", 0.1), ("relmse_trimmed", "trimmed 0.01", 0.01),
          ("relmse_trimmed", "trimmed 0.001", 0.001), ("rmse_percent", "RMSE 1 %", 1.0))


def has_met_all(entries, wanted):
    return all(any(squared_net(e, key) <= squared(key, limit) for e in entries) for key, _, limit in wanted)


def crossing(points, limit):
    """Seconds at which a series of (seconds, squared error) first meets the limit: between two runs by a straight line
    in the log-log plot. The first run's seconds if that met it; None if none did."""
    points = sorted(points)
    if points[0][1] <= limit:
        return points[0][0]
    for (t0, e0), (t1, e1) in zip(points, points[1:]):
        if e1 <= limit:
            share = math.log(e0 / limit) / math.log(e0 / e1) if e1 > 0 else 1
            return t0 * (t1 / t0) ** share
    return None


def targets_table(data, references, unbiased):
    """'<': the shortest run was good enough; '>': the longest was not, and in brackets, for methods without bias, when
    it would be if the squared error went on falling as 1/t."""
    table = Table("seconds_to_error", ["scene", "method"] + [name + " [s]" for _, name, _ in WANTED])
    for scene, method in dict.fromkeys((e["scene"], e["method"]) for e in data):
        entries = [e for e in data if (e["scene"], e["method"]) == (scene, method)]
        texts = [_text(entries, key, limit, references[scene], method in unbiased) for key, _, limit in WANTED]
        table.rows.append([scene, method] + texts)
        table.data.append(dict(zip(table.head, [scene, method] + texts)))
    return table


def _text(entries, key, limit, reference, unbiased):
    points = [(e["seconds"], squared_net(e, key)) for e in entries]
    if not can_tell(reference, key, limit):
        left = net(max(entries, key=lambda e: e["seconds"]), key)
        return "reference too noisy" if left is None or left <= limit else _beyond(points, squared(key, limit), unbiased)
    found = crossing(points, squared(key, limit))
    if found is None:
        return _beyond(points, squared(key, limit), unbiased)
    return ("< " if found == min(points)[0] else "") + figure(found)


def _beyond(points, limit, unbiased):
    last, left = max(points)
    text = "> " + figure(last)
    return f"{text} (~ {figure(last * left / limit, 2)})" if unbiased else text
