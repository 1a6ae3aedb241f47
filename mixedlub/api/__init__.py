"""The Python interface: functions and types of `import mixedlub as ml`."""
