"""Makes what is known of a person, from a minute in which named faces are made and targets are looked at."""
