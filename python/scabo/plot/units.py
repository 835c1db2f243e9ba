"""Names and powers of ten of quantities on axes. A model file has no units, so that without `--units` an axis says `length`,
`force` or `force / length²`, with a power of ten where the numbers need one."""
import dataclasses
import math

METRES = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "km": 1e3}
NEWTONS = {"N": 1.0, "kN": 1e3, "MN": 1e6, "mN": 1e-3}
PREFIXES = {"n": 1e-9, "µ": 1e-6, "m": 1e-3, "": 1.0, "k": 1e3, "M": 1e6, "G": 1e9}
SI = {"length": ("m", "nµm"), "force": ("N", "mkMG"), "stress": ("Pa", "mkMG"), "energy": ("J", "µmkMG")}
PLAIN = {"length": "length", "force": "force", "stress": "force / length²", "energy": "force × length", "number": ""}
DIGITS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class UnitsError(ValueError):
    """A unit that cannot be meant."""


@dataclasses.dataclass(frozen=True)
class Scale:
    factor: float  # what a value of the files is multiplied by
    unit: str      # of the product; may be empty

    def label(self, quantity, between=" "):
        return f"{quantity}{between}({self.unit})" if self.unit else quantity

    def text(self, value):
        """`1.25 MPa`"""
        return f"{self.factor * value:.4g} {self.unit}".strip()


class Units:
    """Units of the model: `Units("m", "N")`; of SI ones prefixes are chosen (mm, kN, MPa), others are only named."""

    def __init__(self, length=None, force=None):
        self.length, self.force = length, force

    @classmethod
    def parse(cls, text):
        """Units from text: length and force, as in `m,N`."""
        parts = [part.strip() for part in text.split(",")]
        if len(parts) != 2 or not all(parts) or any(set(part) & set("$\\{}") for part in parts):
            raise UnitsError(f"--units {text}: give the unit of length and that of force, as in --units m,N")
        return cls(*parts)

    def scale(self, dimension, largest):
        """For values of up to `largest` in size; `dimension` is length, force, stress, energy or number."""
        largest = abs(largest) if math.isfinite(largest) else 0.0
        if dimension in SI and self.length in METRES and self.force in NEWTONS:
            return self._si(dimension, largest)
        named = {"length": self.length, "force": self.force}
        if self.length:
            named |= {"stress": f"{self.force} / {self.length}²", "energy": f"{self.force} {self.length}"}
        unit = named.get(dimension) or PLAIN[dimension]
        if largest == 0.0 or 1e-2 <= largest < 1e4:
            return Scale(1.0, unit)
        power = 3 * math.floor(math.log10(largest) / 3 + 1e-9)
        return Scale(10.0 ** -power, f"10{str(power).translate(DIGITS)} {unit}".strip())

    def _si(self, dimension, largest):
        length, force = METRES[self.length], NEWTONS[self.force]
        base = {"length": length, "force": force, "stress": force / length**2, "energy": force * length}[dimension]
        unit, prefixes = SI[dimension]
        allowed = [(size, prefix) for prefix, size in PREFIXES.items() if prefix == "" or prefix in prefixes]
        fitting = [entry for entry in allowed if largest * base >= (0.0999 if entry[0] <= 1.0 else 0.999) * entry[0]] if largest > 0 else [(1.0, "")]
        size, prefix = max(fitting) if fitting else min(allowed)
        return Scale(base / size, prefix + unit)
