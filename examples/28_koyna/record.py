#!/usr/bin/env python3
"""Writes pulse.csv: the velocity of the ground by the formula of Mavroeidis and Papageorgiou (Bull. Seism. Soc. Am. 93 (2003) 1099) for pulses
beside a fault,

    v = A/2 (1 + cos(2 pi f (t - t0)/g)) cos(2 pi f (t - t0) + phase)    while |t - t0| < g/(2 f),

with A = 0.125 m/s, f = 3 Hz, g = 3 cycles, t0 = 0.5 s and a phase of 90 degrees, with which the ground ends where it began. Its largest
acceleration is 0.23 g. Standard library only."""
import math
import pathlib

AMPLITUDE, FREQUENCY, CYCLES, MIDDLE, STEP, END = 0.125, 3.0, 3.0, 0.5, 0.005, 1.0


def velocity(t):
    since = t - MIDDLE
    if abs(since) >= CYCLES / (2 * FREQUENCY):
        return 0.0
    turn = 2 * math.pi * FREQUENCY * since
    return -0.5 * AMPLITUDE * (1 + math.cos(turn / CYCLES)) * math.sin(turn)


def main():
    lines = ["time (s), velocity (m/s)"]
    lines += [f"{STEP * i:.3f}, {velocity(STEP * i):.6f}" for i in range(round(END / STEP) + 1)]
    pathlib.Path(__file__).resolve().with_name("pulse.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
