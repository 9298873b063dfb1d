"""Files of a scene as the package's programs read them: plain decimals, without exponent."""


def decimal(value):
    """A number as text."""
    return f"{value:.9f}"


def camera_text(camera):
    """Of a camera.yaml. camera: its values by key."""
    return "".join(
        f"{key}: {decimal(value) if isinstance(value, float) else value}\n"
        for key, value in camera.items()
    )


def region_text(region):
    """Of a roi.yaml. region: its lists of numbers by key."""
    return "".join(
        f"{key}: [{', '.join(map(decimal, values))}]\n" for key, values in region.items()
    )
