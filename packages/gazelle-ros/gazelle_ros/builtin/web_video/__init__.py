"""The node ``web_video_server``: topics of images for web pages (http://wiki.ros.org/web_video_server)."""
