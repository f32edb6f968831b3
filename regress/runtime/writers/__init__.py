"""What becomes of answers: tables, and animations of avatars; all take one record."""
