#!/usr/bin/env python3
"""Writes a study file of clips with random settings: organs, textures, cameras, distances, motions,
noise and flaws that no default was chosen by.

usage: data/studies/write_random_study.py --seed 11 --clips 48 > random.toml
       SOFTSCOPE_TEST_DATA=FOLDER softscope study random.toml --out w/random
The same seed and number give the same file. FOLDER holds openhelp/ with Heart.stl, Kidney_right.stl and
Liver.stl; without it those clips are skipped."""
import argparse
import random

HEAD = """title = "Random clips"
about = "{clips} clips of 30 frames with random settings (seed {seed}): organ, texture, camera, distance (36 to 143 mm), motions, shutter, noise, instrument, smoke, row errors. The defaults were chosen by none of them."

[[plot]]
name = "points"
metric = "evaluation.tracks.mean_mm"
p95 = "evaluation.tracks.p95_mm"
label = "error of material points [mm]"
"""
COLUMNS = [
    ("evaluation.outcomes.fused_share", "fused [share]", 2),
    ("evaluation.wrong.frames", "wrong [frames]", 0),
    ("evaluation.wrong.silent_frames", "silently wrong [frames]", 0),
    ("evaluation.tracks.reported", "material points reported [share]", 2),
    ("evaluation.tracks.mean_mm", "material points mean [mm]", 3),
    ("evaluation.tracks.p95_mm", "material points P95 [mm]", 3),
    ("evaluation.tracks.no_motion_control_mm", "had nothing been tracked [mm]", 2),
    ("evaluation.surface.observed.mean_mm", "observed surface mean [mm]", 3),
    ("evaluation.surface.observed.p95_mm", "observed surface P95 [mm]", 3),
    ("evaluation.surface.completeness_1mm", "completeness [share]", 3),
]
ORGANS = ["builtin", "builtin", "Heart", "Kidney_right", "Liver"]
SIZES = [(360, 288), (360, 288), (320, 240), (480, 270), (640, 480)]


def organ_of(chance):
    organ = chance.choice(ORGANS)
    if organ != "builtin":
        return {"organ.mesh": f"${{SOFTSCOPE_TEST_DATA}}/openhelp/{organ}.stl"}
    return {"organ.length_mm": chance.choice([50.0, 60.0, 90.0]),
            "organ.fold_mm": round(chance.uniform(0.3, 2.0), 2),
            "organ.lobe_mm": round(chance.uniform(1, 5), 1)}


def texture_of(chance):
    return {"texture.contrast": chance.choice([0.1, 0.3, 0.6, 1.0]),
            "texture.fat": round(chance.uniform(0.05, 0.5), 2),
            "texture.blood": chance.choice([0.0, 0.0, 0.1, 0.3]),
            "texture.wetness": round(chance.uniform(0.2, 1.6), 2),
            "smoke": chance.choice([0.0, 0.0, 0.0, 0.4])}


def motion_of(chance):
    push_mm = chance.choice([0.0, 0.0, 2.5, 5.0])
    return {"breathing.amplitude_mm": chance.choice([0.0, 1.0, 2.0, 4.0]),
            "heartbeat.amplitude_mm": chance.choice([0.0, 0.8, 1.5]),
            "push.amplitude_mm": push_mm,
            "push.period_s": chance.choice([0.5, 0.8, 1.5]),
            "push.spread_mm": max(chance.choice([6.0, 9.0, 14.0]), 2 * push_mm)}


def scope_of(chance):
    width, height = chance.choice(SIZES)
    scope = {"scope.width_px": width, "scope.height_px": height,
             "scope.focal_px": round(width * chance.uniform(0.7, 1.4), 1),
             "scope.baseline_mm": round(chance.uniform(3.8, 6.0), 2),
             "camera.path": chance.choice(["still", "sweep", "sweep", "orbit", "jerk"]),
             "camera.amplitude_mm": chance.choice([1.0, 4.0, 8.0, 15.0]),
             "camera.period_s": chance.choice([1.0, 2.0, 4.0, 8.0]),
             "camera.distance_mm": round(chance.choice([40, 55, 55, 75, 100, 130]) *
                                         chance.uniform(0.9, 1.1), 1),
             "camera.azimuth_deg": round(chance.uniform(-180, 180), 1),
             "camera.elevation_deg": round(chance.uniform(-40, 40), 1),
             "camera.tremor_mm": chance.choice([0.0, 0.15, 0.3]),
             "frames_per_second": chance.choice([12.5, 25.0, 25.0, 30.0])}
    if chance.random() < 0.25:
        scope["scope.row_error_px"] = round(chance.uniform(-4, 4), 2)
        scope["scope.roll_error_deg"] = round(chance.uniform(-0.3, 0.3), 3)
    return scope


def flaws_of(chance):
    noise = chance.choice([0.003, 0.006, 0.012, 0.02])
    flaws = {"sensor.shutter": chance.choice([0.0, 0.3, 0.5, 0.8]),
             "sensor.noise": noise, "sensor.shot_noise": 2 * noise,
             "sensor.exposure_change": chance.choice([0.0, 0.0, 0.2, 0.4]),
             "sensor.blur_px": chance.choice([0.4, 0.6, 1.0])}
    if chance.random() < 0.3:
        flaws["instrument.radius_mm"] = chance.choice([2.5, 4.0])
        flaws["instrument.reach"] = round(chance.uniform(-0.1, 0.5), 2)
        flaws["instrument.side_deg"] = chance.choice([30.0, 150.0, 205.0, 330.0])
    return flaws


def toml(value):
    return f'"{value}"' if isinstance(value, str) else repr(value)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--seed", type=int, default=11)
    parser.add_argument("--clips", type=int, default=48)
    options = parser.parse_args()
    chance = random.Random(options.seed)
    print(HEAD.format(clips=options.clips, seed=options.seed))
    for metric, label, decimals in COLUMNS:
        print(f'[[column]]\nmetric = "{metric}"\nlabel = "{label}"\ndecimals = {decimals}\n')
    for number in range(options.clips):
        settings = {"frames": 30, "seed": options.seed * 1000 + number}
        for part in (organ_of, texture_of, motion_of, scope_of, flaws_of):
            settings.update(part(chance))
        print(f'[[case]]\nname = "clip-{number:02}"')
        for key, value in settings.items():
            print(f"simulate.{key} = {toml(value)}")
        print()


if __name__ == "__main__":
    main()
