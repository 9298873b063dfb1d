"""The comparison: this detector and those of PCL and OpenCV on the same scenes, and a report."""
