"""A stereo network as an ONNX file, field by field, without weights of any training."""
import struct


def varint(value):
    head = bytearray()
    while value > 127:
        head.append(value & 127 | 128)
        value >>= 7
    return bytes([*head, value])


def number(field, value):
    return varint(field << 3) + varint(value)


def message(field, content):
    content = content.encode() if isinstance(content, str) else content
    return varint(field << 3 | 2) + varint(len(content)) + content


def value_info(name, lengths):
    shape = b"".join(message(1, message(2, n) if isinstance(n, str) else number(1, n))
                     for n in lengths)
    return message(1, name) + message(2, message(1, number(1, 1) + message(2, shape)))


def weights(name, shape, values):
    raw = struct.pack(f"<{len(values)}f", *values)
    return message(5, b"".join(number(1, n) for n in shape) + number(2, 1) + message(8, name)
                   + message(9, raw))


def integers(name, values):
    return message(5, message(1, name) + b"".join(number(8, v) for v in values) + number(20, 7))


def node(operation, inputs, result, *attributes):
    return message(1, b"".join(message(1, name) for name in inputs) + message(2, result)
                   + message(3, "make_" + result) + message(4, operation) + b"".join(attributes))


def plane_sweep(disparities=16, window_px=5, sharpness=4.0):
    """Differences of left and shifted right luma, averaged over a window, and the mean of the
    disparities weighted by softmax(-sharpness * cost)."""
    n, reach, half = disparities, 2 * disparities - 1, window_px // 2
    shifts, sharpen = [0.0] * (n * reach), [0.0] * (n * n)
    for d in range(n):
        shifts[d * reach + n - 1 - d] = 1.0
        sharpen[d * n + d] = -sharpness
    image = (1, 1, "height", "width")
    graph = b"".join([
        message(11, value_info("left", image)), message(11, value_info("right", image)),
        weights("same", (n, 1, 1, 1), [1.0] * n), weights("shifts", (n, 1, 1, reach), shifts),
        weights("sharpen", (n, n, 1, 1), sharpen),
        weights("expect", (1, n, 1, 1), [float(d) for d in range(n)]),
        node("Conv", ["left", "same"], "l", integers("kernel_shape", [1, 1])),
        node("Conv", ["right", "shifts"], "r", integers("kernel_shape", [1, reach]),
             integers("pads", [0, n - 1, 0, n - 1])),
        node("Sub", ["l", "r"], "difference"), node("Abs", ["difference"], "cost"),
        node("AveragePool", ["cost"], "mean", integers("kernel_shape", [window_px, window_px]),
             integers("pads", [half] * 4), integers("strides", [1, 1])),
        node("Conv", ["mean", "sharpen"], "score", integers("kernel_shape", [1, 1])),
        node("Softmax", ["score"], "share",
             message(5, message(1, "axis") + number(3, 1) + number(20, 2))),
        node("Conv", ["share", "expect"], "disparity", integers("kernel_shape", [1, 1])),
        message(12, value_info("disparity", image)), message(2, "stereo")])
    return number(1, 7) + message(7, graph) + message(8, number(2, 11))
