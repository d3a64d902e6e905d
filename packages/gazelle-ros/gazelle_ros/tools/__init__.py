"""Functions of rostopic, rosservice, rosnode and rosparam, which write to a stream."""
