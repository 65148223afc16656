"""A photo and a folder at work: sessions, open photos, learning, labels joined to photos."""
