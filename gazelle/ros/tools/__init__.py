"""What rostopic, rosservice, rosnode and rosparam do, as functions that write to a stream."""
