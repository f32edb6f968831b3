"""What is known of a person before the first frame: neutral pictures, own ends of every range, how the headset sits."""
