"""Do planar and pybullet agree? What is compared, by which tolerance, and the page that says so."""
