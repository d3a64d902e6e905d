"""A base with the sensors of a Kobuki, as text."""

from models import base, plugin

TAGS = {
    "publish_tf": "1",
    "left_wheel_joint_name": "joint0",
    "right_wheel_joint_name": "joint1",
    "wheel_separation": "0.4",
    "wheel_diameter": "0.2",
    "torque": "10",
    "velocity_command_timeout": "0.6",
    "cliff_sensor_left_name": "cliff_l",
    "cliff_sensor_center_name": "cliff_c",
    "cliff_sensor_right_name": "cliff_r",
    "cliff_detection_threshold": "0.2",
    "bumper_name": "bumpers",
    "imu_name": "imu",
}
CLIFF = """<sensor name="cliff_{name}" type="ray"><pose>0.24 {y} 0 0 1.5708 0</pose><update_rate>50
</update_rate><ray><scan><horizontal><samples>1</samples><min_angle>0</min_angle><max_angle>0
</max_angle></horizontal></scan><range><min>0.01</min><max>1</max></range></ray></sensor>"""
SENSORS = (
    "".join(CLIFF.format(name=name, y=y) for name, y in (("l", 0.1), ("c", 0), ("r", -0.1)))
    + '<sensor name="imu" type="imu"><update_rate>100</update_rate></sensor>'
    '<sensor name="bumpers" type="contact"><update_rate>100</update_rate><contact>'
    "<collision>c</collision></contact></sensor>"
)


def kobuki(**tags):
    model = base(plugin("libgazebo_ros_kobuki.so", **{**TAGS, **tags}), wheels=2)
    caster = """<collision name="caster"><pose>-0.2 0 -0.07 0 0 0</pose><geometry><sphere>
    <radius>0.05</radius></sphere></geometry><surface><friction><ode><mu>0</mu><mu2>0</mu2></ode>
    </friction></surface></collision>"""
    return model.replace("</collision>\n    </link>", f"</collision>{caster}{SENSORS}</link>", 1)
