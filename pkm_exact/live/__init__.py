"""A robot in the browser that follows sliders: every pose that is shown was certified for the values shown.

``sliders`` are the actuators with their ranges, ``live_answer`` what is proved at their values, ``stage_items`` what is
drawn of it, as arrays with colours, and ``viser_view`` shows these by viser, an optional package.
"""
