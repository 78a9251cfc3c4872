"""Blocks about the search for a setting that gives the paper's Table I: compression protocols × fit windows of φ_J."""

import collections
import functools
import itertools
import math
import statistics

from scipy.special import chdtr

from data import HERE, SOLIDS, read
from densities import FITS, STABLE_FROM, deviate_of, parts_of, table_i
from estimates import estimate_of
from scaling import jamming_density
from text import counted, number, signed, significant, table
from verdicts import MEAN, verdict

TARGET = 3.2e-5
BASE = ({"before": False, "step": 0.02, "budget": 2000}, "< 0.02")
# A compression protocol and a fit window: Σ of squared normal deviates, root mean square of paper − ours, and for each
# solid our estimate, paper − ours and whether the paper's value lies in our mean's interval.
Entry = collections.namedtuple("Entry", "chi rms setting window found off inside")


def searched_of(data, particles):
    return [r for r in itertools.chain(*data.search.values()) if r.get("particles", 100) == particles]


def settings_of(data, particles=100):
    """{setting: {solid: disordered replicates}} of the search."""
    made = {}
    for replicate in searched_of(data, particles):
        solids = made.setdefault(tuple(sorted(replicate["setting"].items())), {})
        if replicate["status"] == "done" and not {"crystalline"} & set(replicate["flags"]):
            solids.setdefault(replicate["solid"], []).append(replicate)
    return made


def refitted(replicates, fit, solid):
    window = (STABLE_FROM[solid] if fit[0] is None else fit[0], fit[1])
    return estimate_of([jamming_density(r["phi"], r["E"], r["phi_j"], window) for r in replicates])


@functools.cache
def entries_of(data, particles=100):
    """Every compression protocol with every window. chi and rms are None unless all searched solids have three
    replicates."""
    theirs = {f["solid"]: f for f in table_i(data) if f["particles"] == particles}
    made, searched = [], searched_solids(data, particles)
    for setting, solids in settings_of(data, particles).items():
        for name, fit in FITS.items():
            found = {s: refitted(solids.get(s, []), fit, s) for s in searched}
            found = {s: e for s, e in found.items() if e and e["n"] >= 3}
            off = {s: theirs[s]["value"] - e["mean"] for s, e in found.items()}
            inside = {s: verdict(e, theirs[s]) == MEAN for s, e in found.items()}
            chi = rms = None
            if len(found) == len(searched):
                chi = sum(deviate_of(off[s], parts_of(found[s], theirs[s])) ** 2 for s in searched)
                rms = math.sqrt(statistics.fmean(x * x for x in off.values()))
            made.append(Entry(chi, rms, dict(setting), name, found, off, inside))
    return made


def ranked(data, particles=100):
    """Entries with all searched solids, best first."""
    return sorted((e for e in entries_of(data, particles) if e.chi is not None), key=lambda entry: entry.chi)


def searched_solids(data, particles=100):
    """Solids with three replicates for at least one setting; an unfinished search lacks some."""
    return [s for s in SOLIDS if any(len(solids.get(s, [])) >= 3 for solids in settings_of(data, particles).values())]


def all_inside(entries):
    """Settings for which every value of the paper lies in the confidence interval of our mean."""
    return [entry for entry in entries if all(entry.inside.values())]


def is_base(entry):
    return entry.window == BASE[1] and is_base_setting(entry.setting)


def is_base_setting(setting):
    return setting["target"] == TARGET and all(setting[key] == value for key, value in BASE[0].items())


def name_of(setting, *window):
    """Cells of a table: state whose energy is compared with the target, strain step, budget, and window."""
    reading = "before" if setting["before"] else "after"
    if setting["target"] != TARGET:
        reading += f", {significant(setting['target'], 1)}"
    return [reading, number(setting["step"], 3), str(setting["budget"]), *window]


def in_words(setting, window=None):
    reading, step, budget = name_of(setting)
    return f"energy {reading} relaxation, step {step}, budget {budget}" + (f", window {window}" if window else "")


def result(entry, solid):
    """Our φ_J by a setting with n, paper − ours, and a mark if the paper's value is in the confidence interval."""
    if solid not in entry.found:
        return "–"
    estimate = entry.found[solid]
    return (f"{number(estimate['mean'], 4)} ± {number(estimate['half_width'], 4)} ({estimate['n']}), "
            f"{signed(entry.off[solid], 4)}{' *' if entry.inside[solid] else ''}")


def search(data, best=6):
    entries, searched = ranked(data), searched_solids(data)
    if not entries:
        return "These records lack the study.\n"
    shown = entries[:best] + [entry for entry in entries[best:] if is_base(entry)]
    by_size = min(entries, key=lambda entry: entry.rms)
    if by_size not in shown:
        shown.append(by_size)
    rows = [[str(entries.index(e) + 1), *name_of(e.setting, e.window), number(e.chi, 2), number(e.rms, 4),
             *(result(e, s) for s in searched)] for e in shown]
    return table(["rank", "energy before/after relaxation", "step", "budget", "window", "χ²", "rms of paper − ours",
                  *(f"{s}: ours (n), paper − ours" for s in searched)], rows)


@functools.cache
def both_sizes(data):
    """Settings and windows with results for both sizes: (entry of N = 100, entry of N = 400), smallest sum of χ²
    first."""
    small = {(tuple(sorted(e.setting.items())), e.window): e for e in ranked(data)}
    found = [(small[key], e) for e in ranked(data, 400)
             if (key := (tuple(sorted(e.setting.items())), e.window)) in small]
    return sorted(found, key=lambda pair: pair[0].chi + pair[1].chi)


def least_first(pairs, best):
    """Selects from pairs (entry of N = 400, χ² with N = 100). Returns (*pair, True) for the best with N = 100, then
    (*pair, False) for the best with N = 400 if it is not among them. An unknown χ² ranks last."""
    def least(chi):
        return math.inf if chi is None else chi

    chosen = sorted(pairs, key=lambda pair: least(pair[1]))
    large = min(chosen, key=lambda pair: least(pair[0].chi))
    other = [] if large[0].chi is None or large in chosen[:best] else [large]
    return [(*pair, True) for pair in chosen[:best]] + [(*pair, False) for pair in other]


def windows_400(data, best=4):
    """Selected windows of every compression protocol that was run with N = 400."""
    small = {(tuple(sorted(e.setting.items())), e.window): e.chi for e in entries_of(data)}
    protocols = {}
    for e in entries_of(data, 400):
        setting = tuple(sorted(e.setting.items()))
        protocols.setdefault(setting, []).append((e, small.get((setting, e.window))))

    return [shown for setting in sorted(protocols) for shown in least_first(protocols[setting], best)]


def chosen_small(data, what):
    """Settings of the table for N = 400 that were chosen with N = 100 and have a χ² with N = 400: how many it does not
    reject, or the first of them, or its χ²."""
    found = [e for e, _, by_small in windows_400(data) if by_small and e.chi is not None]
    if not found:
        return "–"
    if what == "first":
        return in_words(found[0].setting, found[0].window)
    return number(found[0].chi, 2) if what == "chi" else \
        f"{sum(chdtr(len(SOLIDS), e.chi) < 0.95 for e in found)} of {len(found)}"


@functools.cache
def protocol_of(manifest):
    """Compression protocol of a study of this folder, with defaults from the schema."""
    said = read(HERE / manifest)["protocol"]
    known = read(HERE.parent.parent / "schemas" / "manifest.schema.json")["definitions"]
    return {key: said.get(key, known[key]["default"]) for key in (
        "target_before_relaxation", "consolidation_step", "consolidation_evaluations", "target_energy", "max_density")}


def protocol_value(data, study):
    """The compression protocol of a study, in words."""
    protocol = protocol_of(f"{study}.json")
    return in_words({"before": protocol["target_before_relaxation"], "step": protocol["consolidation_step"],
                     "budget": protocol["consolidation_evaluations"], "target": protocol["target_energy"]})


def search_400(data, best=4):
    """Every compression protocol that was run with N = 400, with its best windows at N = 100. The best window at
    N = 400 is marked if it is not among them."""
    entries, searched = entries_of(data, 400), searched_solids(data, 400)
    if not entries:
        return "These records lack the study.\n"
    rows = [[*name_of(e.setting, e.window + ("" if by_small else " †")),
             *(number(chi, 2) if chi is not None else "–" for chi in (other, e.chi)),
             *(result(e, s) for s in searched)] for e, other, by_small in windows_400(data, best)]
    return table(["energy before/after relaxation", "step", "budget", "window", "χ², N = 100", "χ², N = 400",
                  *(f"{s}, N = 400: ours (n), paper − ours" for s in searched)], rows)


def moved_by(data, setting, solid):
    """Shift of φ_J, 10⁻⁴, relative to the base setting, in pairs of replicates with the same initial configuration."""
    every = [r for r in searched_of(data, 100)
             if r["solid"] == solid and r["status"] == "done" and "crystalline" not in r["flags"]]
    base = {r["replicate"]: r["phi_j"] for r in every if is_base_setting(r["setting"])}
    return estimate_of([1e4 * (r["phi_j"] - base[r["replicate"]]) for r in every
                        if r["setting"] == setting and r["replicate"] in base])


def moves_of(data):
    """(setting, {solid: its shift, of three pairs or more}) of every compression protocol except the base."""
    made = []
    for setting in map(dict, settings_of(data)):
        if not is_base_setting(setting):
            found = {s: moved_by(data, setting, s) for s in SOLIDS}
            made.append((setting, {s: e for s, e in found.items() if e and e["n"] > 2}))
    return sorted(made, key=lambda m: [m[0]["target"] != TARGET, m[0]["before"], m[0]["step"], m[0]["budget"]])


def protocol_shifts(data):
    """Shift of φ_J by each compression protocol, relative to the base."""
    rows = [[*name_of(setting), *(counted(found.get(s)) for s in SOLIDS)] for setting, found in moves_of(data)]
    return table(["energy before/after relaxation", "step", "budget", *SOLIDS], rows) if rows else \
        "These records lack the study.\n"


def completed(data, solid, particles, reading, step, budget):
    """Number of replicates of a compression protocol that completed, and number of all."""
    some = [r for r in searched_of(data, int(particles)) if r["solid"] == solid and name_of(r["setting"]) == [
        reading, step, budget]]
    return f"{sum(r['status'] == 'done' for r in some)} of {len(some)}"


def shift_value(data, which):
    """Smallest and largest shift of φ_J, and numbers of shifts: all, significant ones, negative ones among these."""
    found = [e for _, solids in moves_of(data) for e in solids.values()]
    if not found:
        return "–"
    clear = [e for e in found if abs(e["mean"]) > e["half_width"]]
    return {"least": signed(1e-4 * min(e["mean"] for e in found), 4), "all": str(len(found)), "clear": str(len(clear)),
            "greatest": signed(1e-4 * max(e["mean"] for e in found), 4),
            "down": str(sum(e["mean"] < 0 for e in clear)),
            "before": str(sum(abs(e["mean"]) > e["half_width"] for setting, solids in moves_of(data)
                              for e in solids.values() if setting["before"]))}[which]


def settings_named(entries):
    """The compression protocols of entries, in words."""
    return "; ".join(sorted({in_words(e.setting) for e in entries})) or "none"


def search_value(data, what):
    entries = ranked(data)
    if not entries:
        return "–"
    base = next((e for e in entries if is_base(e)), None)
    pairs = both_sizes(data)
    known = {"count": len(entries), "every": len(entries_of(data)), "windows": len(FITS),
             "protocols": len(settings_of(data)), "complete": len({tuple(sorted(e.setting.items())) for e in entries}),
             "inside": len(all_inside(entries)), "base_rank": entries.index(base) + 1 if base else 0,
             "count_400": len(pairs), "inside_400": len([a for a, b in pairs if all_inside([a]) and all_inside([b])]),
             "untried": len(entries) - len(pairs),
             "untried_protocols": len(settings_of(data)) - len(settings_of(data, 400))}
    if what in known:
        return str(known[what])
    if what == "inside_protocols":
        return settings_named(all_inside(entries))
    if what in ("pair", "pair_100", "pair_400"):  # the best for both sizes
        if not pairs:
            return "–"
        if what == "pair":
            return in_words(pairs[0][0].setting, pairs[0][0].window)
        return number(pairs[0][what == "pair_400"].chi, 2)
    return {"best_chi": number(entries[0].chi, 2), "base_chi": number(base.chi, 2) if base else "–"}[what]


BLOCKS = {f.__name__: f for f in (search, search_400, protocol_shifts)}
VALUES = {"search": search_value, "completed": completed, "shift": shift_value, "chosen_small": chosen_small,
          "protocol": protocol_value,
          "max_density": lambda data, study: number(protocol_of(f"{study}.json")["max_density"], 2)}
