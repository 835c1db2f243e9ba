"""By hand: two cracks of length l at a hole of radius r in a wide plate, K_I = F sigma sqrt(pi l), F of l / r by Bowie (1956), from
tables; the life by Paris' law is the integral of dl / (C K_I^m)."""
import math

BOWIE = ((0.1, 2.73), (0.2, 2.41), (0.3, 2.15), (0.4, 1.96), (0.5, 1.83), (0.6, 1.71), (0.8, 1.58), (1.0, 1.45))  # l / r, F


def factor(part):
    """F, linear between the rows of the table."""
    for (low, f), (high, g) in zip(BOWIE, BOWIE[1:]):
        if part <= high:
            return f + (g - f) * (part - low) / (high - low)
    raise ValueError("beyond the table")


def life(first, last, r=0.01, stress=80e6, C=1e-29, m=3, parts=1000):
    """Cycles, by the midpoint rule."""
    step = (last - first) / parts
    lengths = [first + (k + 0.5) * step for k in range(parts)]
    return sum(step / (C * (factor(l / r) * stress * math.sqrt(math.pi * l))**m) for l in lengths)


if __name__ == "__main__":
    print(f"{life(0.001, 0.008):.0f} cycles")
