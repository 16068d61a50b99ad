"""What both wings share: the columns of the tables, files that are whole or not there."""
