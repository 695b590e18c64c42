"""Fixtures of every metric with the values that its published formula gives.

Usage: metric_fixtures.py OUT.json. Written from the formulas alone, in plain Python: it shares no
code with the program, and solves alignments by another method (Horn's quaternion, Jacobi rotations).
"""
import json
import math
import random
import struct
import sys


def mean(values):
    return sum(values) / len(values)


def distance(a, b):
    return math.sqrt(sum((x - y) ** 2 for x, y in zip(a, b)))


def quantile(values, percent):
    ordered = sorted(values)
    rank = (len(ordered) - 1) * percent / 100
    low = int(rank)
    high = min(low + 1, len(ordered) - 1)
    return ordered[low] + (rank - low) * (ordered[high] - ordered[low])


# Points: STIR 2026 (AJ, ATA, OA) and STIR to 2025 (delta_avg).
def tracking(rng):
    thresholds = [2, 4, 8, 16, 32]
    points = [{"error": rng.expovariate(1 / 6.0), "truly_visible": rng.random() < 0.7,
               "said_visible": rng.random() < 0.75} for _ in range(500)]
    points[0]["error"] = 4.0  # on a threshold: not within it
    jaccard, accuracy = [], []
    for limit in thresholds:
        tp = fp = fn = 0
        for p in points:
            good = p["error"] < limit and p["truly_visible"] and p["said_visible"]
            tp += good
            if p["said_visible"] and not good:
                fp += 1
            if p["truly_visible"] and not good:
                fn += 1
        jaccard.append(tp / (tp + fp + fn))
        seen = [p for p in points if p["truly_visible"]]
        accuracy.append(sum(p["error"] < limit for p in seen) / len(seen))
    return {"points": points, "thresholds": thresholds, "jaccard_at": jaccard,
            "accuracy_at": accuracy, "average_jaccard": mean(jaccard),
            "average_accuracy": mean(accuracy),
            "occlusion_accuracy": mean([p["truly_visible"] == p["said_visible"] for p in points])}


def end_points(rng):
    thresholds = [2, 4, 8, 16, 32]
    truth = [[rng.uniform(-30, 30) for _ in range(3)] for _ in range(40)]
    found = [[x + rng.gauss(0, 6) for x in p] for p in truth]
    found[0] = [truth[0][0] + 2.0, truth[0][1], truth[0][2]]
    truth[1] = [500.0, 0.0, 0.0]
    found[1] = [504.0, 0.0, 0.0]  # on a threshold: within it
    nearest = [min(distance(p, q) for q in truth) for p in found]
    at = [sum(d <= limit for d in nearest) / len(nearest) for limit in thresholds]
    return {"truth": truth, "estimate": found, "thresholds": thresholds, "accuracy_at": at,
            "average_accuracy": mean(at), "mean": mean(nearest), "median": quantile(nearest, 50)}


# Boxes: SurgT.
def overlap(a, b):
    width = max(0.0, min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0]))
    height = max(0.0, min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1]))
    return width * height / (a[2] * a[3] + b[2] * b[3] - width * height)


def middle(box):
    return int(box[0] + box[2] / 2), int(box[1] + box[3] / 2)


def in_space(left, right, rig):
    (u, v), (u_right, _) = middle(left), middle(right)
    d = u - u_right
    if d <= 0:
        return None
    z = rig["focal_px"] * rig["baseline_mm"] / d
    return [(u - rig["cx_px"]) * z / rig["focal_px"], (v - rig["cy_px"]) * z / rig["focal_px"], z]


def one_track(truth, start, boxes, rig, misses_allowed=10, limit=0.1, cap_mm=100.0):
    """Protocol of the challenge: a run ends with 11 successive misses, which then don't count."""
    last = max(i for i, t in enumerate(truth) if t["visible"] and not t["difficult"])
    ious, errors, spaces, curve = [], [], [], []
    hits_2d = hits_3d = seen = excess = miss_2d = miss_3d = 0
    failed_2d = failed_3d = False

    def add(frame, value):
        if frame <= last:
            curve.append(value)

    for frame in range(start + 1, len(truth)):
        t, found = truth[frame], boxes[frame - start - 1]
        if t["difficult"] or not t["visible"]:
            add(frame, None)
        else:
            seen += 1
            if failed_2d:
                add(frame, 0.0)
        if (failed_2d and failed_3d) or t["difficult"]:
            continue
        if not t["visible"]:
            excess += found is not None and t["boxes"] is None
            continue
        iou = 0.0
        if found is None:
            ious.append(None)
            errors.append(None)
            spaces.append(None)
            miss_2d += 1
            miss_3d += 1
        else:
            if not failed_2d:
                pair = [overlap(a, b) for a, b in zip(t["boxes"], found)]
                iou = mean(pair)
                ious.append(iou)
                errors.append(mean([distance(middle(a), middle(b))
                                    for a, b in zip(t["boxes"], found)]))
                if min(pair) > limit:
                    hits_2d += 1
                    miss_2d = 0
                else:
                    miss_2d += 1
            if not failed_3d:
                p, q = in_space(*found, rig), in_space(*t["boxes"], rig)
                far = None if p is None or q is None else distance(p, q)
                spaces.append(far)
                if far is not None and far <= cap_mm:
                    hits_3d += 1
                    miss_3d = 0
                else:
                    miss_3d += 1
        add(frame, iou)
        if not failed_2d and miss_2d > misses_allowed:
            failed_2d = True
            del ious[-misses_allowed - 1:], errors[-misses_allowed - 1:]
        if not failed_3d and miss_3d > misses_allowed:
            failed_3d = True
            del spaces[-misses_allowed - 1:]
    kept = [e for e in errors if e is not None]
    kept_3d = [e for e in spaces if e is not None]
    return {"accuracy": mean([i for i in ious if i is not None]) if kept else 0.0,
            "robustness_2d": hits_2d / (seen + excess), "robustness_3d": hits_3d / (seen + excess),
            "error_px": mean(kept) if kept else None, "error_mm": mean(kept_3d) if kept_3d else None,
            "frames_2d": len(kept), "frames_3d": len(kept_3d), "frames_judged": seen + excess,
            "overlaps": curve}


def curve_of(sequences):
    curve = []
    for rank in range(max(len(s) for s in sequences)):
        known = [s[rank] for s in sequences if rank < len(s) and s[rank] is not None]
        curve.append(mean(known) if known else None)
    return curve


def boxes(rng):
    rig = {"focal_px": 560.0, "baseline_mm": 4.2, "cx_px": 319.5, "cy_px": 239.5}
    targets, curves, all_tracks = [], [], []
    for target in range(3):
        truth = []
        for frame in range(120):
            u, v = 300 + 40 * math.sin(frame / 17 + target), 200 + 30 * math.cos(frame / 23)
            d = 40 + 6 * math.sin(frame / 11)
            hidden, hard = 50 <= frame < 58, frame % 37 == 5 and frame > 0
            pair = [[u, v, 40, 36], [u - d, v, 40, 36]]
            truth.append({"visible": not hidden, "difficult": hard,
                          "boxes": None if hidden and frame != 52 else pair})
        tracks = []
        for start in (0, 60):
            found = []
            for frame in range(start + 1, 120):
                pair = truth[frame]["boxes"] or [[300, 200, 40, 36], [260, 200, 40, 36]]
                du, dv, dd = (rng.gauss(0, 4) for _ in range(3))
                if target == 1 and start == 0 and frame > 70:
                    du, dd = 35, 0      # off in 2-D, right in disparity
                if target == 2 and 20 < frame < 45:
                    dd = 60.0           # negative disparity
                box = [[pair[0][0] + du, pair[0][1] + dv, 40, 36],
                       [pair[1][0] + du + dd, pair[1][1] + dv, 40, 36]]
                gone = rng.random() < 0.05 or (target == 0 and start == 60 and frame > 100)
                found.append(None if gone else box)
            judged = one_track(truth, start, found, rig)
            tracks.append({"first_frame": start, "boxes": found, "expected": judged})
        curves.append(curve_of([t["expected"]["overlaps"] for t in tracks]))
        all_tracks += [t["expected"] for t in tracks]
        targets.append({"truth": truth, "tracks": tracks})

    def merged(key, weight):
        total = sum(t[weight] for t in all_tracks)
        return sum(t[key] * t[weight] for t in all_tracks if t[weight]) / total

    rank = curve_of(curves)[10:60]
    return {"rig": rig, "targets": targets, "first_rank": 10, "last_rank": 60,
            "expected_average_overlap": mean([x for x in rank if x is not None]),
            "merged": {"accuracy": merged("accuracy", "frames_2d"),
                       "error_px": merged("error_px", "frames_2d"),
                       "error_mm": merged("error_mm", "frames_3d"),
                       "robustness_2d": merged("robustness_2d", "frames_judged"),
                       "robustness_3d": merged("robustness_3d", "frames_judged")}}


# Paths: ATE and RPE by evo's definitions, alignment by Horn's quaternion (1987).
def product(a, b):
    return [[sum(x * y for x, y in zip(row, column)) for column in zip(*b)] for row in a]


def transpose(a):
    return [list(column) for column in zip(*a)]


def apply(a, v):
    return [sum(x * y for x, y in zip(row, v)) for row in a]


def rotation(q):
    w, x, y, z = q
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v]


def largest_eigenvector(matrix):
    """Of a symmetric matrix, by Jacobi rotations."""
    n = len(matrix)
    a = [row[:] for row in matrix]
    vectors = [[float(i == j) for j in range(n)] for i in range(n)]
    for _ in range(100):
        for p in range(n):
            for q in range(p + 1, n):
                if abs(a[p][q]) < 1e-300:
                    continue
                theta = (a[q][q] - a[p][p]) / (2 * a[p][q])
                t = math.copysign(1, theta) / (abs(theta) + math.sqrt(theta * theta + 1))
                c = 1 / math.sqrt(t * t + 1)
                turn = [[float(i == j) for j in range(n)] for i in range(n)]
                turn[p][p] = turn[q][q] = c
                turn[p][q], turn[q][p] = t * c, -t * c
                a = product(product(transpose(turn), a), turn)
                vectors = product(vectors, turn)
    best = max(range(n), key=lambda i: a[i][i])
    return [row[best] for row in vectors]


def align(source, target, scaled):
    n = len(source)
    s_mean = [mean(c) for c in zip(*source)]
    t_mean = [mean(c) for c in zip(*target)]
    s = [[x - m for x, m in zip(p, s_mean)] for p in source]
    t = [[x - m for x, m in zip(p, t_mean)] for p in target]
    m = [[sum(s[i][a] * t[i][b] for i in range(n)) for b in range(3)] for a in range(3)]
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = m
    q = largest_eigenvector([[xx + yy + zz, yz - zy, zx - xz, xy - yx],
                             [yz - zy, xx - yy - zz, xy + yx, zx + xz],
                             [zx - xz, xy + yx, -xx + yy - zz, yz + zy],
                             [xy - yx, zx + xz, yz + zy, -xx - yy + zz]])
    r = rotation(unit(q))
    scale = 1.0
    if scaled:
        turned = [apply(r, p) for p in s]
        scale = (sum(sum(a * b for a, b in zip(p, u)) for p, u in zip(t, turned)) /
                 sum(sum(a * a for a in p) for p in s))
    shift = [a - scale * b for a, b in zip(t_mean, apply(r, s_mean))]
    return scale, r, shift


def angle_deg(r):
    """Of a rotation, by sine and cosine: exact also near 0."""
    sine = math.sqrt((r[2][1] - r[1][2]) ** 2 + (r[0][2] - r[2][0]) ** 2 +
                     (r[1][0] - r[0][1]) ** 2) / 2
    return math.degrees(math.atan2(sine, (r[0][0] + r[1][1] + r[2][2] - 1) / 2))


def between(a, b):
    """a^-1 b of poses (R, t)."""
    back = transpose(a[0])
    return product(back, b[0]), apply(back, [y - x for x, y in zip(a[1], b[1])])


def rms(values):
    return math.sqrt(mean([v * v for v in values]))


def path_scores(truth, found, scaled):
    scale, r, shift = align([p[1] for p in found], [p[1] for p in truth], scaled)
    moved = [(product(r, p[0]), [scale * x + y for x, y in zip(apply(r, p[1]), shift)])
             for p in found]
    ate = [between(a, b) for a, b in zip(truth, moved)]
    rpe = [between(between(truth[i], truth[i + 1]), between(moved[i], moved[i + 1]))
           for i in range(len(truth) - 1)]
    return {"scale": scale, "ate_rmse_mm": rms([distance(d[1], [0, 0, 0]) for d in ate]),
            "ate_rmse_deg": rms([angle_deg(d[0]) for d in ate]),
            "rpe_rmse_mm": rms([distance(d[1], [0, 0, 0]) for d in rpe]),
            "rpe_rmse_deg": rms([angle_deg(d[0]) for d in rpe])}


def paths(rng):
    truth, found = [], []
    world = rotation(unit([0.8, 0.3, -0.4, 0.2]))
    for i in range(60):
        r = rotation(unit([1, 0.01 * i, 0.004 * i, -0.006 * i]))
        t = [20 * math.cos(i / 9), 15 * math.sin(i / 7), 0.4 * i]
        truth.append((r, t))
        noise = rotation(unit([1] + [rng.gauss(0, 0.004) for _ in range(3)]))
        p = [0.93 * x + y + rng.gauss(0, 0.5) for x, y in zip(apply(world, t), (5, -8, 30))]
        found.append((product(product(world, r), noise), p))
    flat = [[sum(r, []) + t for r, t in path] for path in (truth, found)]
    return {"truth": flat[0], "estimate": flat[1], "se3": path_scores(truth, found, False),
            "sim3": path_scores(truth, found, True)}


# Maps and pictures.
def single(value):
    """As a depth map holds it: 32 bits."""
    return struct.unpack("f", struct.pack("f", value))[0]


def depth(rng):
    width, height = 24, 18
    truth = [single(rng.uniform(40, 120)) if rng.random() < 0.9 else None
             for _ in range(width * height)]
    found = [None if rng.random() < 0.2 else single((t or 80) + rng.gauss(0, 2)) for t in truth]
    known = [i for i, t in enumerate(truth) if t is not None]
    errors = [abs(found[i] - truth[i]) for i in known if found[i] is not None]
    return {"width": width, "height": height, "truth_mm": truth, "measured_mm": found,
            "mae_mm": mean(errors), "rmse_mm": rms(errors), "median_mm": quantile(errors, 50),
            "bad_percent": [100 * sum(e > k for e in errors) / len(errors) for k in (1, 2, 3)],
            "coverage_percent": 100 * len(errors) / len(known)}


def exact_luma(pixel):
    return 0.299 * pixel[0] + 0.587 * pixel[1] + 0.114 * pixel[2]


def luma(pixel):
    return round(exact_luma(pixel))


def rounds_clearly(pixel):
    """Of a luma half way between two numbers no formula says which one it becomes."""
    return abs(exact_luma(pixel) % 1 - 0.5) > 0.01


def ssim(a, b, ignored, width, height):
    """Wang et al. 2004: Gaussian window 11 x 11, sigma 1.5; windows without ignored pixels."""
    window = [[math.exp(-(i * i + j * j) / 4.5) for i in range(-5, 6)] for j in range(-5, 6)]
    total = sum(map(sum, window))
    c1, c2 = (0.01 * 255) ** 2, (0.03 * 255) ** 2
    values = []
    for v in range(5, height - 5):
        for u in range(5, width - 5):
            around = [(window[j + 5][i + 5] / total, (v + j) * width + u + i)
                      for j in range(-5, 6) for i in range(-5, 6)]
            if any(ignored[k] for _, k in around):
                continue
            mx = sum(w * a[k] for w, k in around)
            my = sum(w * b[k] for w, k in around)
            vx = sum(w * (a[k] - mx) ** 2 for w, k in around)
            vy = sum(w * (b[k] - my) ** 2 for w, k in around)
            xy = sum(w * (a[k] - mx) * (b[k] - my) for w, k in around)
            values.append((2 * mx * my + c1) * (2 * xy + c2) /
                          ((mx * mx + my * my + c1) * (vx + vy + c2)))
    return mean(values)


def pictures(rng):
    width, height = 32, 26
    a, b = [], []
    while len(a) < width * height:
        drawn = [rng.randrange(256) for _ in range(3)]
        photograph = [min(255, max(0, c + rng.randrange(-25, 26))) for c in drawn]
        if rounds_clearly(drawn) and rounds_clearly(photograph):
            a.append(drawn)
            b.append(photograph)
    ignored = [i % width < 6 and i // width < 9 for i in range(width * height)]
    squares = [sum((x - y) ** 2 for x, y in zip(p, q)) for p, q, no in zip(a, b, ignored) if not no]
    return {"width": width, "height": height, "drawn": a, "photograph": b,
            "ignored": [int(x) for x in ignored],
            "psnr_db": 10 * math.log10(255 ** 2 / (sum(squares) / (3 * len(squares)))),
            "psnr_over_all_pixels_db":
                10 * math.log10(255 ** 2 / (sum(squares) / (3 * width * height))),
            "ssim": ssim([luma(p) for p in a], [luma(p) for p in b], ignored, width, height)}


def main():
    rng = random.Random(20260)
    fixtures = {"tracking": tracking(rng), "end_points": end_points(rng), "boxes": boxes(rng),
                "paths": paths(rng), "depth": depth(rng), "pictures": pictures(rng)}
    with open(sys.argv[1], "w", encoding="utf-8") as out:
        json.dump(fixtures, out)


if __name__ == "__main__":
    main()
