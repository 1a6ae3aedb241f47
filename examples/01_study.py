"""Run a study from Python and ask the labelled result a question: what does smoothing one flank buy?"""

from pathlib import Path

import mixedlub as ml

results = ml.study.run(Path(__file__).with_name("study_21_pairings.toml"))
data = results.to_xarray().set_index(pairing=["pinion_surface", "gear_surface"]).sel(oil_temperature_C=60)
loss = data["power_loss_W"]

print("Power loss (W) at 100 N m, against 0450 / 0450")
for rpm in loss.speed_rpm.values:
    rough = float(loss.sel(pairing=("0450", "0450"), torque_Nm=100, speed_rpm=rpm))
    one = float(loss.sel(pairing=("0036", "0450"), torque_Nm=100, speed_rpm=rpm))
    both = float(loss.sel(pairing=("0036", "0036"), torque_Nm=100, speed_rpm=rpm))
    saved = f"one flank smooth {one:6.1f} ({one / rough - 1:+.0%}), both {both:6.1f} ({both / rough - 1:+.0%})"
    print(f"{rpm:6.0f} rpm: {rough:6.1f}; {saved}")
