"""Which increments a page contains where it has no room for all of them."""
import heapq


def in_order_of_importance(count, ends):
    """Numbers 1 to `count`: the last one, the first one, those of `ends` (of steps) from the last, then again and again the middle of
    the largest run of missing ones, so that however many are taken, they are spread evenly."""
    order = [number for number in dict.fromkeys([count, 1, *reversed(ends)]) if 1 <= number <= count]
    taken = sorted(order)
    gaps = [(low - high, low, high) for low, high in zip(taken, taken[1:]) if high - low > 1]
    heapq.heapify(gaps)  # the longest one first
    while gaps:
        _, low, high = heapq.heappop(gaps)
        middle = (low + high) // 2
        order.append(middle)
        for start, end in ((low, middle), (middle, high)):
            if end - start > 1:
                heapq.heappush(gaps, (start - end, start, end))
    return order


def listed(numbers):
    """`1 to 4, 8, 10`"""
    runs = []
    for number in sorted(numbers):
        if runs and number == runs[-1][1] + 1:
            runs[-1][1] = number
        else:
            runs.append([number, number])
    if len(runs) > 8:
        runs = runs[:5] + [None] + runs[-2:]
    return ", ".join("..." if run is None else str(run[0]) if run[0] == run[1] else f"{run[0]}{' to ' if run[1] > run[0] + 1 else ', '}{run[1]}"
                     for run in runs)


def mesh_may_change(results):
    """Whether bodies are added or removed in a run, pairs found anew (`slip: large`), or cracks grow, so that increments have meshes of their own."""
    return not results.modal and any(entry.get("absent") or "pairs_found_anew" in entry or "growth" in entry for entry in results.increments)
