"""Settings of the whole suite: property tests are deterministic and not timed, so a busy machine cannot fail them."""

from hypothesis import settings

settings.register_profile("suite", deadline=None, derandomize=True)
settings.load_profile("suite")
