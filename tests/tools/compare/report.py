# SPDX-License-Identifier: GPL-3.0-or-later
"""The summary of a comparison, the most important first."""
from differences import KINDS, Difference

MOST = 8         # of each kind, without --all
COUNTED = 0.005  # counts that differ by less are the same
SHORT = 0.05     # seconds of processor time: shorter runs are no measure


def groups(found):
    """Differences of one kind, those of the same words together: [[difference, ...], ...] by weight."""
    by_group = {}
    for each in sorted(found, key=Difference.key):
        by_group.setdefault((each.sensitive, each.group or id(each)), []).append(each)
    return list(by_group.values())


def show(group):
    first = group[0]
    more = f"  ({len(group)} scenes)" if len(group) > 1 else ""
    mark = "sensitive: another tolerance moves the base by as much\n    " if first.sensitive else ""
    print(f"  {first.scene}{more}\n    {mark}{first.words}\n    {first.folder}\n      {first.command[1]}")
    if len(group) > 1:
        print(f"    also {', '.join(each.scene for each in group[1:4])}{', ...' if len(group) > 4 else ''}")


def show_kinds(plan, found):
    for kind, words in KINDS.items():
        mine = [each for each in found if each.kind == kind]
        if not mine:
            continue
        count = len({each.scene for each in mine})
        print(f"\n{count} scenes: {words}")
        shown = groups(mine)
        for group in shown if plan.all else shown[:MOST]:
            show(group)
        if len(shown) > MOST and not plan.all:
            print(f"  ... and {len(shown) - MOST} more (--all)")


def show_counts(counts):
    """Instructions that differ, the largest ratio first; whether any does."""
    changed = [(new / old if old and new else float("inf"), scene, old, new) for scene, old, new in counts
               if old is None or new is None or abs(new - old) > COUNTED * old]
    if counts:
        print(f"\ninstructions of {len(counts)} scenes: {len(counts) - len(changed)} the same within {100 * COUNTED:g} %")
    for ratio, scene, old, new in sorted((each for each in changed if each[2] or each[3]), reverse=True):
        print(f"  {ratio:6.3f} times  {scene}  {old or 'fails'} -> {new or 'fails'}")


def show_times(seconds):
    """Ratios of processor time: of all scenes, and the scenes with the largest."""
    pairs = {scene: [sum(side) for side in zip(*used.values())] for scene, used in seconds.items() if used}
    old, new = (sum(pair[side] for pair in pairs.values()) for side in (0, 1))
    if old > 0:
        print(f"\nprocessor time: {new / old:.2f} times the base's in all")
    ratios = sorted(((pair[1] / max(pair[0], 1e-3), str(scene)) for scene, pair in pairs.items()
                     if max(pair) > SHORT), reverse=True)
    for ratio, scene in [each for each in ratios if each[0] > 1.5][:MOST]:
        print(f"  {ratio:6.2f} times  {scene}")


def write(plan, found, seconds, counts):
    """Print the summary; the exit code."""
    show_kinds(plan, found)
    show_counts(counts)
    show_times(seconds)
    scenes = {each.scene for each in found}
    slower = [scene for scene, old, new in counts if old and new and new > 1.1 * old]
    firm = {each.scene for each in found if not each.sensitive}
    print(f"\n{len(seconds)} scenes: {len(scenes)} differ ({len(scenes - firm)} of them only as sensitive as they are), "
          f"{len(slower)} take more than 1.1 times the instructions")
    if found:
        print(f"pairs of outputs: {plan.folder / 'differ'}/SCENE/OUTPUT/base and /new")
    return 1 if found or slower else 0
