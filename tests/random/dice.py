"""Random choices that are the same on every machine and for every version of Python: only `random()` of the standard
library is used, whose sequence is guaranteed."""
import math
import random


class Dice:
    def __init__(self, seed):
        self._random = random.Random(seed)

    def uniform(self, low=0.0, high=1.0):
        return low + (high - low) * self._random.random()

    def number(self, low, high):
        """Of three digits, so that model files can be read."""
        return short(self.uniform(low, high))

    def log(self, low, high):
        """Of three digits, all orders of magnitude alike."""
        return short(math.exp(self.uniform(math.log(low), math.log(high))))

    def whole(self, low, high):
        """Both ends included."""
        return low + int((high - low + 1) * self._random.random())

    def chance(self, probability):
        return self._random.random() < probability

    def sign(self):
        return -1 if self.chance(0.5) else 1

    def choice(self, items):
        items = list(items)
        return items[self.whole(0, len(items) - 1)]

    def weighted(self, weights):
        """One of the keys of a map of weights."""
        left = self.uniform(0, sum(weights.values()))
        for item, weight in weights.items():
            left -= weight
            if left < 0:
                return item
        return item

    def shuffled(self, items):
        items = list(items)
        for last in range(len(items) - 1, 0, -1):
            other = self.whole(0, last)
            items[last], items[other] = items[other], items[last]
        return items


def short(value, digits=3):
    return float(f"{value:.{digits}g}")
