"""Nodelets of ``depth_image_proc``: depth images as clouds, in metres, and in the view of other cameras."""
