"""World with one part of every kind: links, a joint, sensors and lights."""

LAMP_WORLD = """
<sdf version="1.6"><world name="room">
<light name="sun" type="directional"><direction>-0.3 0.2 -1</direction></light>
<light name="bulb" type="point"><pose>0.3 0.3 1.5 0 0 0</pose><diffuse>1 1 1 1</diffuse></light>
<model name="ground"><static>true</static><link name="l">
 <collision name="c"><geometry><plane><normal>0 0 1</normal><size>3 3</size></plane></geometry></collision>
 <visual name="v"><geometry><plane><normal>0 0 1</normal><size>3 3</size></plane></geometry></visual></link></model>
<model name="box"><pose>0 0 0.5 0 0 0</pose><link name="l">
 <inertial><mass>20</mass><inertia><ixx>4</ixx><iyy>4</iyy><izz>4</izz></inertia></inertial>
 <collision name="c"><geometry><box><size>1 1 1</size></box></geometry></collision>
 <visual name="v"><geometry><box><size>1 1 1</size></box></geometry>
  <material><diffuse>0.9 0.1 0.1 1</diffuse></material></visual></link></model>
<model name="lamp"><pose>-1 -0.2 0 0 0 0</pose>
 <link name="foot"><pose>0 0 0.1 0 0 0</pose><inertial><mass>3</mass>
   <inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.15</izz></inertia></inertial>
  <collision name="c"><geometry><box><size>0.6 0.6 0.2</size></box></geometry></collision>
  <visual name="v"><geometry><box><size>0.6 0.6 0.2</size></box></geometry></visual></link>
 <link name="arm"><pose>0 0 0.7 0 0 0</pose><inertial><mass>0.5</mass>
   <inertia><ixx>0.05</ixx><iyy>0.05</iyy><izz>0.001</izz></inertia></inertial>
  <visual name="v"><geometry><box><size>0.1 0.1 1</size></box></geometry></visual>
  <sensor name="scan" type="ray"><ray><scan><horizontal><samples>9</samples>
   <min_angle>-1</min_angle><max_angle>1</max_angle></horizontal></scan>
   <range><min>0.1</min><max>1.5</max></range></ray></sensor>
  <sensor name="eye" type="camera"><pose>0 0 0.4 0 0 3.14159</pose><camera><horizontal_fov>1</horizontal_fov>
   <image><width>64</width><height>48</height></image><clip><near>0.1</near><far>1</far></clip></camera></sensor></link>
 <joint name="hinge" type="revolute"><parent>foot</parent><child>arm</child><pose>0 0 -0.5 0 0 0</pose>
  <axis><xyz>0 1 0</xyz><limit><lower>-1</lower><upper>1</upper></limit></axis></joint></model>
</world></sdf>
"""
