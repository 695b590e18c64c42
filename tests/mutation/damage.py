"""What happens to a file: bits, bytes, cuts, and numbers and words of texts."""
import random
import re

NUMBER = re.compile(rb"[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?")
HOSTILE_NUMBERS = [b"0", b"-1", b"nan", b"inf", b"-inf", b"1e308", b"1e-308", b"-0.0", b"2147483648",
                   b"4294967296", b"9223372036854775808", b"1099511627776", b"32767", b"65536",
                   b"0.0000001", b"1e34", b"", b"text", b"0x10", b"1,5", b"1e", b"--1"]
HOSTILE_WORDS = [b"%s%s%n", b"\x00", b"\x1b[2J", b"\n", b"\r\n", b"\xff\xfe", b"../..", b"'", b'"',
                 b"(", b")", b"[" * 200, b"a." * 200, b"#", b"{", b"LIST", b"None"]
TEXT_SHARE = 0.85  # of printable bytes, from which on a file's beginning is a text


def looks_like_text(data):
    head = data[:400]
    printable = sum(byte in b"\t\n\r" or 32 <= byte < 127 for byte in head)
    return bool(head) and printable >= TEXT_SHARE * len(head)


def header_of(data):
    """How many bytes belong to the part that says what the others mean."""
    for end in (b"end_header\n", b"ElementDataFile = LOCAL\n", b"\n\n"):
        at = data.find(end, 0, 20000)
        if at >= 0:
            return at + len(end)
    return min(len(data), 400)


def place_in(data, rng):
    """Half of all damage goes to the header."""
    limit = header_of(data) if rng.random() < 0.5 else len(data)
    return rng.randrange(max(1, limit))


def flip_bit(data, rng):
    at = place_in(data, rng)
    data[at] ^= 1 << rng.randrange(8)


def set_byte(data, rng):
    data[place_in(data, rng)] = rng.choice([0, 1, 127, 128, 255, rng.randrange(256)])


def cut_end(data, rng):
    del data[place_in(data, rng):]


def drop_stretch(data, rng):
    at = place_in(data, rng)
    del data[at:at + rng.choice([1, 2, 4, 16, 256])]


def double_stretch(data, rng):
    at = place_in(data, rng)
    data[at:at] = data[at:at + rng.choice([1, 4, 16, 256])]


def zero_stretch(data, rng):
    at = place_in(data, rng)
    length = min(rng.choice([1, 2, 4, 8, 64]), len(data) - at)
    data[at:at + length] = bytes([rng.choice([0, 255])]) * length


def set_integer(data, rng):
    at, width = place_in(data, rng), rng.choice([2, 4, 8])
    value = rng.choice([0, 1, 2, 0x7fff, 0x8000, 0x7fffffff, 0x80000000, 0xffffffff, 1 << 40])
    data[at:at + width] = (value % (1 << 8 * width)).to_bytes(width, rng.choice(["little", "big"]))


def replace_number(data, rng):
    found = list(NUMBER.finditer(bytes(data[:20000])))
    if found:
        which = rng.choice(found)
        data[which.start():which.end()] = rng.choice(HOSTILE_NUMBERS)


def insert_word(data, rng):
    at = place_in(data, rng)
    data[at:at] = rng.choice(HOSTILE_WORDS)


def change_line(data, rng):
    """Drops, doubles or moves a line."""
    lines = bytes(data[:20000]).split(b"\n")
    at = rng.randrange(len(lines))
    line = lines.pop(at)
    kind = rng.randrange(3)
    if kind == 1:
        lines[at:at] = [line, line]
    elif kind == 2:
        lines.insert(rng.randrange(len(lines) + 1), line)
    data[:20000] = b"\n".join(lines)


BINARY = [flip_bit, set_byte, cut_end, drop_stretch, double_stretch, zero_stretch, set_integer]
TEXT = [replace_number, replace_number, replace_number, insert_word, change_line, change_line]


def damaged(original, rng: random.Random):
    """A copy with one to four damages."""
    data = bytearray(original)
    kinds = BINARY + (TEXT * 2 if looks_like_text(original) else [])
    for _ in range(rng.choice([1, 1, 1, 2, 3, 4])):
        if not data:
            break
        rng.choice(kinds)(data, rng)
    return bytes(data)
