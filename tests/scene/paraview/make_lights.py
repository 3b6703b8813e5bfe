"""Makes what VTK itself computes for light kits (states/lights.truth).

    /usr/bin/python3 tests/scene/paraview/make_lights.py > tests/scene/paraview/states/lights.truth

Written with VTK 9.1 (Debian 12). Every line is a light: the kit's name; x y z towards it in the
world of the camera of surfaces.pvsm; red, green and blue with the intensity in them.
"""
import vtk

KITS = {
    "usual": {},
    "other": {"KeyLightIntensity": 1.25, "KeyLightWarmth": 0.9, "KeyLightAngle": (20, -35),
              "KeyToFillRatio": 2.5, "FillLightWarmth": 0.07, "FillLightAngle": (-60, 25),
              "KeyToBackRatio": 6, "BackLightWarmth": 0.31, "BackLightAngle": (15, 140),
              "KeyToHeadRatio": 4.5, "HeadLightWarmth": 1.0, "MaintainLuminance": 1},
}


def camera():
    made = vtk.vtkCamera()
    made.SetPosition(4.0, -9.0, 5.0)
    made.SetFocalPoint(0.1, 0.2, -0.3)
    made.SetViewUp(0.1, 0.2, 1.0)
    return made


def directions(light, eye):
    transform = eye.GetCameraLightTransformMatrix()
    at, to = (transform.MultiplyPoint((*place, 1.0))
              for place in (light.GetPosition(), light.GetFocalPoint()))
    difference = [a - b for a, b in zip(at[:3], to[:3])]
    length = sum(part * part for part in difference) ** 0.5
    return [part / length for part in difference]


for name, settings in KITS.items():
    kit, renderer = vtk.vtkLightKit(), vtk.vtkRenderer()
    for key, value in settings.items():
        getattr(kit, "Set" + key)(value)
    kit.AddLightsToRenderer(renderer)
    kit.Update()
    for light in renderer.GetLights():
        color = [light.GetIntensity() * channel for channel in light.GetDiffuseColor()]
        print(name, *(f"{number:.9g}" for number in directions(light, camera()) + color))
