#!/usr/bin/env python3
"""Draws section.png, a section of concrete: aggregate (255) in mortar (0), 256 x 256 pixels. Standard library only; the random numbers
are the same in every version of Python."""
import argparse
import pathlib
import random
import struct
import zlib

HERE = pathlib.Path(__file__).resolve().parent
PIXELS = 256
GRADING = [(34, 2), (26, 3), (19, 6), (13, 10), (9, 18), (6, 30)]  # radius in pixels, number of grains
GAP = 3  # pixels of mortar between two grains at least


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("-o", "--output", type=pathlib.Path, default=HERE / "section.png", metavar="FILE", help="default: %(default)s")
    options = parser.parse_args()
    image = picture_of(grains())
    options.output.write_bytes(png_of(image))
    print(f"{options.output}: aggregate {sum(row.count(255) for row in image) / PIXELS**2:.6f} of the area")


def grains():
    """Centre and radius; the large ones are placed first, at random where there is room."""
    numbers, placed = random.Random(15), []
    for radius, count in GRADING:
        for _ in range(count):
            for _ in range(100000):
                x, y = (radius + GAP + (PIXELS - 2 * (radius + GAP)) * numbers.random() for _ in "xy")
                if all((x - a)**2 + (y - b)**2 >= (radius + r + GAP)**2 for a, b, r in placed):
                    placed.append((x, y, radius))
                    break
            else:
                raise SystemExit(f"no room for a grain of radius {radius}")
    return placed


def picture_of(placed):
    image = [bytearray(PIXELS) for _ in range(PIXELS)]
    for x, y, radius in placed:
        for row in range(int(y - radius), int(y + radius) + 1):
            for column in range(int(x - radius), int(x + radius) + 1):
                if (column + 0.5 - x)**2 + (row + 0.5 - y)**2 <= radius**2:
                    image[row][column] = 255
    return image


def png_of(image):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", PIXELS, PIXELS, 8, 0, 0, 0, 0)  # 8 bits, grey
    rows = b"".join(b"\0" + bytes(row) for row in image)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


if __name__ == "__main__":
    main()
