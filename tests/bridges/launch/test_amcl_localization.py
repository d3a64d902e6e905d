"""amcl follows recorded drives as closely as the original's own tests ask, and finds a robot anywhere."""

from __future__ import annotations

import math
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from amcl_drives import DRIVES, command, hall, record, save_hall
from launching import Launched, environment
from PIL import Image
from ports import free_port
from ros.graph import until

from gazelle.bridges.navigation.frames import GraphFrames
from gazelle_ros import Master, Node, load_service

MAPS = ("willow-full.pgm", "willow-full-0.05.pgm")


def test_drives_keep_away_from_walls_and_end_where_they_are_to(tmp_path):
    save_hall(tmp_path)
    drive = DRIVES["global_localization_stage"]
    end = record(drive, tmp_path, tmp_path / "drive.bag")
    assert end[:2] == pytest.approx(drive.end[:2], abs=0.12)
    assert abs(math.remainder(end[2] - drive.end[2], 2 * math.pi)) < 0.02
    assert 0.05 < hall().mean() < 0.5
    assert command((0.0, 0.0, 0.0), (1.0, 0.0), None) == (0.8, 0.0)


def originals():
    """Return the folder ``amcl/test`` of a checkout of navigation in ``GAZELLE_ROBOTS``."""
    found = Path(os.environ.get("GAZELLE_ROBOTS", "")) / "navigation" / "amcl"
    if not (found / "test" / "basic_localization.py").is_file():
        pytest.skip("no checkout of navigation is at hand (set GAZELLE_ROBOTS)")
    return found


def package_with(original, folder, name):
    """Return a package ``amcl`` with the original's script and launch file, our hall and bag."""
    tests = folder / "packages" / "amcl" / "test"
    tests.mkdir(parents=True)
    shutil.copy(original / "package.xml", tests.parent)
    for file in ("basic_localization.py", "set_pose.py", f"{name}.xml"):
        shutil.copy(original / "test" / file, tests)
        (tests / file).chmod(0o755)
    save_hall(tests, *MAPS)
    resolution = 0.05 if "0.05" in (tests / f"{name}.xml").read_text() else 0.1
    if resolution == 0.05:
        _refine(tests / MAPS[1])
    shutil.copy(tests / "hall.png", folder)
    drive, bag = FILES[name]
    record(DRIVES[drive], folder, tests / bag)
    return folder / "packages", tests / f"{name}.xml"


def _refine(path):
    """Write the same map with cells of half the side."""
    with Image.open(path) as picture:
        picture.resize((2 * picture.width, 2 * picture.height), Image.Resampling.NEAREST).save(path)


# Launch files of its suite, the drive in place of the bag they play, and what that bag is called.
BASIC = "basic_localization_stage_indexed.bag"
FILES = {
    "basic_localization_stage": ("basic_localization_stage", BASIC),
    "global_localization_stage": ("global_localization_stage", "global_localization_stage_indexed.bag"),
    "rosie_multilaser": ("rosie_multilaser", "rosie_localization_stage.bag"),
    "set_initial_pose": ("basic_localization_stage", BASIC),
    "set_initial_pose_delayed": ("set_initial_pose_delayed", BASIC),
    "small_loop_prf": ("small_loop_prf", "small_loop_prf_indexed.bag"),
    **{
        name + kind: (name, f"{name}_indexed.bag")
        for name in ("small_loop_crazy_driving_prg", "texas_greenroom_loop", "texas_willow_hallway_loop")
        for kind in ("", "_corrected")
    },
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(FILES))
def test_its_own_script_is_content(tmp_path, name):
    packages, file = package_with(originals(), tmp_path, name)
    done = run_test(file, packages, tmp_path)
    assert done.returncode == 0, done.stdout[-4000:] + done.stderr[-4000:]


def run_test(file, packages, folder):
    """Run a rostest file, and return what came of it."""
    return subprocess.run(
        [sys.executable, "-m", "gazelle", "launch", "--test", str(file), "-p", str(free_port())],
        env=environment("", packages, folder), cwd=folder,
        capture_output=True, text=True, timeout=400, check=False,
    )  # fmt: skip


LAUNCH = """
<launch>
  <param name="use_sim_time" value="true"/>
  <node pkg="map_server" type="map_server" name="map_server" args="{folder}/hall.pgm 0.1"/>
  <node pkg="rosbag" type="play" name="rosbag" args="-d 8 --clock --hz 20 {folder}/drive.bag"/>
  <node pkg="amcl" type="amcl" name="amcl">
    <rosparam subst_value="true">
      {{min_particles: 500, max_particles: 5000, kld_err: 0.05, laser_max_beams: 30, odom_model_type: {model},
       odom_alpha1: 0.2, odom_alpha2: 0.2, odom_alpha3: 0.8, odom_alpha4: 0.2, odom_alpha5: 0.1,
       laser_z_hit: 0.5, laser_z_rand: 0.5, laser_model_type: {laser}, update_min_d: 0.2, update_min_a: 0.5,
       resample_interval: 1, recovery_alpha_slow: 0.0, recovery_alpha_fast: 0.0, odom_frame_id: {odom},
       initial_pose_x: {x}, initial_pose_y: {y}, initial_pose_a: {a}}}
    </rosparam>
    <remap from="scan" to="base_scan"/>
  </node>
</launch>
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "model", "laser"),
    [
        ("basic_localization_stage", "omni", "likelihood_field"),
        ("global_localization_stage", "diff", "likelihood_field"),
        ("small_loop_prf", "omni", "likelihood_field_prob"),
    ],
)
def test_a_drive_is_followed_as_closely_as_that_script_asks(tmp_path, name, model, laser):
    drive = DRIVES[name]
    save_hall(tmp_path, "hall.pgm")
    record(drive, tmp_path, tmp_path / "drive.bag")
    x, y, a = drive.guess or (0.0, 0.0, 0.0)
    values = {"x": x, "y": y, "a": a, "odom": drive.odom, "model": model, "laser": laser}
    (tmp_path / "drive.launch").write_text(LAUNCH.format(folder=tmp_path, **values))
    with (
        Master(port=0) as master,
        Launched(master.uri, "", tmp_path, str(tmp_path / "drive.launch")) as launched,
    ):
        launched.wait_for([], {"/amcl_pose"}, set())
        with Node("/looker", master_uri=master.uri) as node:
            frames = GraphFrames(node)
            until(lambda: node.clock.now() > 0, 120.0)
            if drive.guess is None:
                empty = load_service("std_srvs/Empty")
                node.client("/global_localization", empty).call(empty._request_class())
            begun = node.clock.now()
            until(lambda: node.clock.now() - begun > 1e9 * drive.seconds, 400.0)

            def there(place, turn):
                """Return whether it knows its place.

                On a busy machine it may be some scans behind.
                """
                found = frames.pose("map", "base_link")
                return (
                    found is not None
                    and max(abs(a - b) for a, b in zip(found[:2], drive.end[:2], strict=True))
                    < place
                    and abs(math.remainder(found[2] - drive.end[2], 2 * math.pi)) < turn
                )

            until(lambda: there(*drive.tolerances))
